"""Renders one of our scenes by Blender's Cycles, for `./carlo bench peers`:

    python3 cycles_peer.py -- SCENE.json

The JSON file is what peer_scene.cpp writes. The image goes to the EXR file it names, and one line
"carlo: {...}" with the seconds to stdout.
"""

import json
import shutil
import sys
import time

import bpy
import addon_utils  # available once bpy is loaded
from mathutils import Matrix

import peer


def add_material(spec):
    """Lambertian reflection plus emission; one-sided materials are mixed with black by the visible
    side."""
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = spec["reflectance"] + [1]
    diffuse.inputs["Roughness"].default_value = 0
    front = diffuse.outputs[0]
    back = diffuse.outputs[0] if spec["two_sided"] else None
    if any(spec["radiance"]):
        # Strength 1 makes the colour a radiance: Cycles' light is not divided by pi.
        emission = nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = spec["radiance"] + [1]
        emission.inputs["Strength"].default_value = 1
        front = emission.outputs[0]
        if any(spec["reflectance"]):
            both = nodes.new("ShaderNodeAddShader")
            links.new(emission.outputs[0], both.inputs[0])
            links.new(diffuse.outputs[0], both.inputs[1])
            front = both.outputs[0]
    surface = front
    if back is not front:
        sides = nodes.new("ShaderNodeMixShader")
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], sides.inputs[0])
        links.new(front, sides.inputs[1])
        if back is not None:
            links.new(back, sides.inputs[2])
        surface = sides.outputs[0]
    links.new(surface, nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_mesh(spec, materials):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(spec["positions"], [], spec["faces"])
    if "normals" in spec:
        mesh.polygons.foreach_set("use_smooth", [True] * len(spec["faces"]))
        mesh.normals_split_custom_set_from_vertices(spec["normals"])
    mesh.materials.append(materials[spec["material"]])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))


def add_camera(spec):
    """Blender's camera looks along its -z axis, +x to the right."""
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.sensor_width = 36
    camera.lens = camera.sensor_width / (2 * spec["tan_half_x"])
    camera.clip_start, camera.clip_end = 1e-6, 1e12
    thing = bpy.data.objects.new("camera", camera)
    axes = [spec["right"], spec["up"], [-x for x in spec["forward"]], spec["origin"]]
    thing.matrix_world = Matrix([[axis[i] for axis in axes] for i in range(3)] + [[0, 0, 0, 1]])
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def unbiased_path_tracing(scene, spec):
    """Switches off whatever changes the image's expectation; samples count only for their own pixel."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"
    cycles.blur_glossy = 0
    cycles.use_auto_tile = False
    cycles.time_limit = 0
    cycles.max_bounces = cycles.diffuse_bounces = spec["bounces"]
    cycles.seed = spec["seed"]
    cycles.use_guiding = spec.get("guiding", False)
    if hasattr(cycles, "use_light_tree"):
        cycles.use_light_tree = spec.get("light_tree", True)
    # Owen-scrambled Sobol' points, as ours; the default of 3.4 leaves the same error.
    for name in ["SOBOL", "SOBOL_BURLEY", "TABULATED_SOBOL"]:  # of Blender 3.4, 3.5 and 4.0
        try:
            cycles.sampling_pattern = name
            break
        except TypeError:
            pass


def linear_exr(scene, spec):
    render = scene.render
    render.resolution_x, render.resolution_y = spec["width"], spec["height"]
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.use_compositing = render.use_sequencer = False
    render.dither_intensity = 0
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "NONE"
    scene.view_settings.view_transform = "Raw"
    scene.view_settings.exposure, scene.view_settings.gamma = 0, 1


def processor_seconds(scene, samples):
    """Cycles' very first sample goes through the pixel's centre, which at 64 samples makes the light of
    the Cornell box too dark by .1 % of the image; a later block of the sequence is equally even."""
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.cycles.samples = scene.cycles.sample_offset = samples
    start = time.process_time()
    bpy.ops.render.render()
    return time.process_time() - start


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        spec = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles")  # the Python module starts without it
    scene = bpy.context.scene
    scene.world = None  # no light but the scene's
    unbiased_path_tracing(scene, spec)
    linear_exr(scene, spec)
    add_camera(spec["camera"])
    materials = [add_material(material) for material in spec["materials"]]
    for mesh in spec["meshes"]:
        add_mesh(mesh, materials)
    # The fixed cost of a render (Blender's scene, the tree over the triangles, the film) is in both
    # times, and cancels in their difference.
    processor_seconds(scene, 1)
    one = processor_seconds(scene, 1)
    all_samples = processor_seconds(scene, spec["samples"])
    bpy.data.images["Render Result"].save_render(spec["output"])
    seconds = (all_samples - one) * spec["samples"] / (spec["samples"] - 1)
    answer = {"version": bpy.app.version_string, "seconds": seconds, "fixed_seconds": one}
    print("carlo: " + json.dumps(answer), flush=True)


def remove_temporary_files():
    shutil.rmtree(bpy.app.tempdir, ignore_errors=True)


if __name__ == "__main__":
    peer.run_and_end(main, remove_temporary_files)
