"""LuxCore's path tracer, bidirectional path tracer, or path tracer with its cache of caustics; see
peer.py."""

import math
import time

import pyluxcore

import peer


def words(values):
    return " ".join(repr(float(v)) for v in values)


def set_all(properties, prefix, values):
    for key, value in values.items():
        properties.Set(pyluxcore.Property(f"{prefix}.{key}", value))


def add_material(properties, name, spec):
    """One-sided materials are black on the back. Emission is on the side of the normal."""
    prefix = "scene.materials." + name
    if spec["kind"] == "mirror":
        set_all(properties, prefix + "front", {"type": "mirror", "kr": list(spec["reflectance"])})
    elif spec["kind"] == "dielectric":
        set_all(properties, prefix, {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3,
                                     "interiorior": spec["int_ior"], "exteriorior": spec["ext_ior"]})
        return
    else:
        set_all(properties, prefix + "front", {"type": "matte", "kd": list(spec["reflectance"])})
    set_all(properties, prefix + "back", {"type": "matte", "kd": [0.0] * 3})
    emission = {}
    if any(spec["radiance"]):
        emission = {"emission": list(spec["radiance"]), "emission.gain": [1.0] * 3, "emission.power": 0.0,
                    "emission.efficency": 0.0}
    if spec["two_sided"]:
        kind = "mirror" if spec["kind"] == "mirror" else "matte"
        key = "kr" if kind == "mirror" else "kd"
        set_all(properties, prefix, {"type": kind, key: list(spec["reflectance"]), **emission})
    else:
        set_all(properties, prefix, {"type": "twosided", "frontmaterial": name + "front",
                                     "backmaterial": name + "back", **emission})


def triangles(faces):
    return [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]


def add_camera(properties, spec):
    camera = spec["camera"]
    wide = spec["width"] >= spec["height"]
    tangent = camera["tan_half_x"] * (1 if wide else spec["height"] / spec["width"])
    # Without a filter, LuxCore counts each sample one row too low.
    width, height = spec["width"], spec["height"]
    x, y = max(width / height, 1.0), max(height / width, 1.0)
    row = 2 * y / height
    target = [o + f for o, f in zip(camera["origin"], camera["forward"])]
    set_all(properties, "scene.camera", {
        "type": "perspective", "lookat.orig": list(camera["origin"]), "lookat.target": target,
        "up": list(camera["up"]), "screenwindow": [-x, x, -y - row, y - row], "fieldofview": math.degrees(2 * math.atan(tangent)),
        "autovolume.enable": False, "cliphither": 1e-6, "clipyon": 1e6})


def scene_of(spec):
    scene = pyluxcore.Scene()
    properties = pyluxcore.Properties()
    add_camera(properties, spec)
    scene.Parse(properties)
    properties = pyluxcore.Properties()
    for i, material in enumerate(spec["materials"]):
        add_material(properties, f"m{i}", material)
    for i, mesh in enumerate(spec["meshes"]):
        scene.DefineMesh(f"mesh{i}", [tuple(p) for p in mesh["positions"]], triangles(mesh["faces"]),
                         [tuple(n) for n in mesh["normals"]] if "normals" in mesh else None, None, None, None)
        set_all(properties, f"scene.objects.o{i}", {"shape": f"mesh{i}", "material": f"m{mesh['material']}"})
    for i, light in enumerate(spec["point_lights"]):
        set_all(properties, f"scene.lights.l{i}", {
            "type": "point", "position": list(light["position"]), "color": list(light["intensity"]),
            "gain": [4 * math.pi] * 3, "power": 0.0, "efficency": 0.0})
    if any(spec["environment"]):
        set_all(properties, "scene.lights.environment", {"type": "constantinfinite", "color": list(spec["environment"])})
    scene.Parse(properties)
    return scene


def settings_of(spec):
    """Unbiased except for the cache: no clamping, no filter, no colour corrections, one thread."""
    depth = spec["max_depth"] or 1024
    properties = pyluxcore.Properties()
    set_all(properties, "film", {
        "width": spec["width"], "height": spec["height"], "filter.type": "NONE",
        "imagepipelines.0.0.type": "NOP", "outputs.0.type": "RGB", "outputs.0.filename": spec["output"],
        "noiseestimation.warmup": 1 << 30})
    for key, value in {
            "renderengine.type": spec["integrator"], "renderengine.seed": spec["seed"],
            "sampler.type": "SOBOL", "sampler.sobol.adaptive.strength": 0.0, "native.threads.count": 1,
            "batch.haltspp": [spec["samples"], 0], "path.pathdepth.total": depth,
            "path.pathdepth.diffuse": depth, "path.pathdepth.glossy": depth, "path.pathdepth.specular": depth,
            "path.clamping.variance.maxvalue": 0.0, "path.maxdepth": depth, "light.maxdepth": depth,
            "scene.epsilon.min": 1e-6, "scene.epsilon.max": 1e-3,
            "path.photongi.caustic.enabled": bool(spec["caustic_cache"]),
            "path.photongi.sampler.type": "METROPOLIS"}.items():
        properties.Set(pyluxcore.Property(key, value))
    return properties


def main():
    spec = peer.read_scene()
    pyluxcore.Init(lambda message: None)
    config = pyluxcore.RenderConfig(settings_of(spec), scene_of(spec))
    session = pyluxcore.RenderSession(config)

    def render():
        session.Start()
        while not session.HasDone():
            time.sleep(.01)
            session.UpdateStats()
        session.Stop()

    seconds = peer.processor_seconds(render)
    session.GetFilm().SaveOutputs()
    peer.answer(pyluxcore.Version(), seconds)


if __name__ == "__main__":
    main()
