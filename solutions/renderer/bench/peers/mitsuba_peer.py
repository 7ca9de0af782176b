"""Mitsuba 3's path tracer or its particle tracer; see peer.py."""

import math

import drjit
import mitsuba as mi
import numpy

import peer


def rgb(value):
    return {"type": "rgb", "value": value}


def add_bsdf(spec):
    if spec["kind"] == "mirror":
        bsdf = {"type": "conductor", "material": "none", "specular_reflectance": rgb(spec["reflectance"])}
    elif spec["kind"] == "dielectric":
        return {"type": "dielectric", "int_ior": spec["int_ior"], "ext_ior": spec["ext_ior"]}
    else:
        bsdf = {"type": "diffuse", "reflectance": rgb(spec["reflectance"])}
    return {"type": "twosided", "bsdf": bsdf} if spec["two_sided"] else bsdf


def columns(x, y, z, origin):
    return mi.ScalarTransform4f([[x[i], y[i], z[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]])


def rectangle(positions):
    """Mitsuba's rectangle is [-1, 1]^2, facing z."""
    origin, u, _, v = positions
    half_u = [(a - b) / 2 for a, b in zip(u, origin)]
    half_v = [(a - b) / 2 for a, b in zip(v, origin)]
    normal = [half_u[(i + 1) % 3] * half_v[(i + 2) % 3] - half_u[(i + 2) % 3] * half_v[(i + 1) % 3]
              for i in range(3)]
    length = math.sqrt(sum(x * x for x in normal))
    center = [o + a + b for o, a, b in zip(origin, half_u, half_v)]
    return {"type": "rectangle", "to_world": columns(half_u, half_v, [x / length for x in normal], center)}


def mesh(spec, name):
    if len(spec["faces"]) == 1 and len(spec["faces"][0]) == 4:
        return rectangle(spec["positions"])
    path = name + ".ply"
    corners = spec["positions"]
    columns = "x y z"
    if "normals" in spec:
        corners = [p + n for p, n in zip(corners, spec["normals"])]
        columns += " nx ny nz"
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(corners)}\n" +
                   "".join(f"property float {column}\n" for column in columns.split()) +
                   f"element face {len(spec['faces'])}\nproperty list uchar int vertex_index\nend_header\n")
        for corner in corners:
            file.write(" ".join(repr(x) for x in corner) + "\n")
        for face in spec["faces"]:
            file.write(" ".join(map(str, [len(face)] + face)) + "\n")
    return {"type": "ply", "filename": path, "face_normals": "normals" not in spec}


FINER = {"columns": 8, "rows": 32}  # Mitsuba texels per texel of ours


def envmap_json(spec):
    """Mitsuba interpolates between texels, but ours are constant: each of ours becomes many, so that only
    a narrow rim is interpolated. Mitsuba's columns are at the middles of equal parts, as ours; its rows
    are at 0, 1/(n - 1), ..., 1 of the way down, and each is the mean of the nearest part. With a quarter
    of these rows a directly visible sky is off by 1e-4, which shows."""
    height = spec["height"]
    texels = numpy.array(spec["radiance"]).reshape(height, spec["width"], 3)
    rows = FINER["rows"] * height
    edges = numpy.clip((numpy.arange(rows + 1) - 0.5) / (rows - 1), 0, 1) * height
    whole = numpy.minimum(edges.astype(int), height - 1)
    above = numpy.concatenate([numpy.zeros_like(texels[:1]), numpy.cumsum(texels, axis=0)])
    down_to = above[whole] + (edges - whole)[:, None, None] * texels[whole]
    finer = numpy.diff(down_to, axis=0) / numpy.diff(edges)[:, None, None]
    finer = numpy.repeat(finer.astype(numpy.float32), FINER["columns"], axis=1)
    return {"type": "envmap", "bitmap": mi.Bitmap(finer),
            "to_world": columns(spec["x"], spec["y"], spec["z"], [0, 0, 0])}


def sensor(spec):
    """Mitsuba's camera looks along its z axis, +x to the left."""
    camera = spec["camera"]
    return {
        "type": "perspective",
        "to_world": columns([-x for x in camera["right"]], camera["up"], camera["forward"], camera["origin"]),
        "fov": math.degrees(2 * math.atan(camera["tan_half_x"])),
        "fov_axis": "x",
        "near_clip": 1e-6,
        "far_clip": 1e6,
        "film": {"type": "hdrfilm", "width": spec["width"], "height": spec["height"], "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}},
        "sampler": {"type": spec["points"], "sample_count": spec["samples"], "seed": spec["seed"]},
    }


def scene_of(spec):
    scene = {
        "type": "scene",
        "integrator": {"type": spec["integrator"], "max_depth": spec["max_depth"] or -1},
        "sensor": sensor(spec),
    }
    shapes = [mesh(m, f"{spec['output']}.{i}") for i, m in enumerate(spec["meshes"])]
    shapes += [{"type": "sphere", "center": s["center"], "radius": s["radius"], "flip_normals": s["flipped"]}
               for s in spec["spheres"]]
    for i, (shape, own) in enumerate(zip(shapes, spec["meshes"] + spec["spheres"])):
        material = spec["materials"][own["material"]]
        shape["bsdf"] = add_bsdf(material)
        if any(material["radiance"]):
            shape["emitter"] = {"type": "area", "radiance": rgb(material["radiance"])}
        scene[f"shape{i}"] = shape
    for i, light in enumerate(spec["point_lights"]):
        scene[f"light{i}"] = {"type": "point", "position": light["position"], "intensity": rgb(light["intensity"])}
    if any(spec["environment"]):
        scene["environment"] = {"type": "constant", "radiance": rgb(spec["environment"])}
    if spec["envmap"]:
        scene["environment"] = envmap_json(spec["envmap"])
    return scene


def main():
    spec = peer.read_scene()
    mi.set_variant(spec["variant"])
    mi.set_log_level(mi.LogLevel.Error)
    drjit.set_thread_count(1)
    scene = mi.load_dict(scene_of(spec), parallel=False)
    images = []

    def render(seed):
        image = mi.render(scene, spp=spec["samples"], seed=seed)
        drjit.eval(image)
        drjit.sync_thread()
        images.append(image)

    render(spec["seed"] + 1000)  # the LLVM variant compiles its kernel once and keeps it
    seconds = peer.processor_seconds(lambda: render(spec["seed"]))
    drjit.set_thread_count(2)  # with a single thread, writing waits for itself
    mi.Bitmap(images[-1]).write(spec["output"])
    peer.answer(mi.__version__, seconds)


if __name__ == "__main__":
    main()
