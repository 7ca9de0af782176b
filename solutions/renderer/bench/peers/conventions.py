"""Renders one row of `./carlo bench peers --conventions` (conventions.h) with another renderer:

    python3 conventions.py TASK.json

The task holds what the programs beside this one read, and in "theirs" the row's own lines of Python, run
once the scene stands: they add to it or change it, and say what is measured by value(image), an image as
rows from the top (default: its mean in the row's window). Prints one line "carlo: {...}" with the values
of independent runs and the version.
"""

import json
import math
import sys

import numpy

import peer


def mitsuba(task, run):
    import drjit
    import mitsuba as mi
    import mitsuba_peer
    mi.set_variant("scalar_rgb")
    mi.set_log_level(mi.LogLevel.Error)
    drjit.set_thread_count(2)  # with a single thread, writing waits for itself
    s = mitsuba_peer.scene_of({**task, "integrator": "path", "points": "independent"})
    run(s=s, mi=mi)
    scene = mi.load_dict(s, parallel=False)
    return mi.__version__, lambda seed: numpy.array(mi.render(scene, spp=task["samples"], seed=seed))


def cycles(task, run):
    import bpy
    import addon_utils
    import cycles_peer
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles")
    scene = bpy.context.scene
    cycles_peer.unbiased_path_tracing(scene, task)
    cycles_peer.linear_exr(scene, task)
    cycles_peer.add_camera(task["camera"])
    scene.world = None
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.cycles.samples = scene.cycles.sample_offset = task["samples"]
    materials = [cycles_peer.add_material(m) for m in task["materials"]]
    for mesh in task["meshes"]:
        cycles_peer.add_mesh(mesh, materials)

    def put(data, at=(0, 0, 0), turn=(0, 0, 0)):
        thing = bpy.data.objects.new("thing", data)
        thing.location, thing.rotation_euler = at, [math.radians(a) for a in turn]
        scene.collection.objects.link(thing)
        return data

    def lamp(kind, at=(0, 0, 0), turn=(0, 0, 0), **values):
        data = bpy.data.lights.new("lamp", kind)
        for name, value in values.items():
            setattr(data, name, value)
        return put(data, at, turn)

    def nodes(i, kind, **inputs):
        """A node of this kind alone as the surface of material i."""
        tree = materials[i].node_tree
        tree.nodes.clear()
        node = tree.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            node.inputs[name.replace("_", " ")].default_value = value
        tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        return node

    def world(strength=1.0, color=(1, 1, 1, 1)):
        scene.world = bpy.data.worlds.new("world")
        scene.world.use_nodes = True
        background = scene.world.node_tree.nodes["Background"]
        background.inputs["Color"].default_value, background.inputs["Strength"].default_value = color, strength
        return scene.world.node_tree, background

    def sky(name):
        tree, background = world()
        scene.world.cycles.sampling_method = "MANUAL"  # a small table of the map is made sooner
        scene.world.cycles.sample_map_resolution = 64
        image = tree.nodes.new("ShaderNodeTexEnvironment")
        image.image, image.interpolation = bpy.data.images.load(task["maps"] + name), "Closest"
        tree.links.new(image.outputs[0], background.inputs["Color"])

    def default(thing, *names):
        for name in names:
            setattr(thing, name, thing.bl_rna.properties[name].default)

    run(bpy=bpy, scene=scene, cycles=scene.cycles, camera=scene.camera.data, lamp=lamp, nodes=nodes, world=world,
        sky=sky, default=default)

    def render(seed):
        scene.cycles.seed = seed
        bpy.ops.render.render()
        bpy.data.images["Render Result"].save_render(task["output"])
        image = bpy.data.images.load(task["output"])
        pixels = numpy.array(image.pixels[:]).reshape(image.size[1], image.size[0], image.channels)
        bpy.data.images.remove(image)
        return pixels[::-1, :, :3]

    return bpy.app.version_string, render


def luxcore(task, run):
    import pyluxcore
    import time
    import luxcore_peer
    pyluxcore.Init(lambda message: None)
    scene = luxcore_peer.scene_of({"materials": [], "meshes": [], "point_lights": [], "environment": [0], **task})
    settings = luxcore_peer.settings_of({**task, "integrator": "PATHCPU", "caustic_cache": False})
    extra = {"output": pyluxcore.FilmOutputType.RGB}

    def add(prefix, **values):
        properties = pyluxcore.Properties()
        luxcore_peer.set_all(properties, "scene." + prefix, {k.replace("_", "."): v for k, v in values.items()})
        scene.Parse(properties)

    run(settings=settings, scene=scene, add=add, pyluxcore=pyluxcore, extra=extra,
        set_=lambda **v: [settings.Set(pyluxcore.Property(k.replace("_", "."), x)) for k, x in v.items()])

    def render(seed):
        settings.Set(pyluxcore.Property("renderengine.seed", seed))
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(settings, scene))
        session.Start()
        while not session.HasDone():
            time.sleep(.01)
            session.UpdateStats()
        session.Stop()
        film = session.GetFilm()
        pixels = numpy.zeros(film.GetWidth() * film.GetHeight() * 3, numpy.float32)
        film.GetOutputFloat(extra["output"], pixels, 0, True)
        return pixels.reshape(film.GetHeight(), film.GetWidth(), 3)[::-1]

    return pyluxcore.Version(), render


def main():
    task = peer.read_scene()
    x0, y0, x1, y1 = task["window"]
    names = {"math": math, "numpy": numpy, "task": task}
    names["value"] = lambda image: image[y0:y1, x0:x1].mean(dtype=numpy.float64)

    def run(**own):
        names.update(own)
        exec(task["theirs"], names)

    version, render = {"mitsuba": mitsuba, "cycles": cycles, "luxcore": luxcore}[task["peer"]](task, run)
    values = [float(names["value"](render(task["seed"] + i))) for i in range(task["runs"])]
    print("\ncarlo: " + json.dumps({"version": version, "values": values}), flush=True)


def clean_up():
    if "cycles_peer" in sys.modules:
        sys.modules["cycles_peer"].remove_temporary_files()


if __name__ == "__main__":
    peer.run_and_end(main, clean_up)
