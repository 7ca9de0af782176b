#!/usr/bin/env bash
# Mitsuba 3.9.1: eight cubes, each with its own id, that share a material.
# Expected: scene.shapes() has eight entries, and traverse() offers "c3.vertex_positions".
# Seen: meshes with the same material are merged on loading. One mesh without an id is left, whose
# parameters are named after its address ("object_94889565557696.faces"), so the names differ from
# run to run. Spheres are left alone: five cubes and three spheres give four shapes.
# Do: load with optimize=False when shapes are looked up, moved or counted later.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi
mi.set_variant("scalar_rgb")

def scene(kinds):
    shapes = "".join(f'<shape type="{kind}" id="c{i}"><transform name="to_world"><translate x="{3*i}"/>'
                     f'</transform><ref id="paint"/></shape>' for i, kind in enumerate(kinds))
    return f'<scene version="3.0.0"><bsdf type="diffuse" id="paint"/>{shapes}</scene>'

eight = scene(["cube"] * 8)
merged = mi.load_string(eight)
ids = [shape.id() for shape in merged.shapes()]
hold(ids == [""], f"eight cubes load as {ids}")
area = merged.shapes()[0].surface_area()
hold(abs(area - 8 * 24) < 1e-2, f"the merged mesh has area {area}, not 192")
keys = list(mi.traverse(merged).keys())
hold(not any(key.startswith("c") and ".faces" in key for key in keys), f"named parameters: {keys}")
mixed = len(mi.load_string(scene(["cube"] * 5 + ["sphere"] * 3)).shapes())
hold(mixed == 4, f"five cubes and three spheres load as {mixed} shapes")
kept = [shape.id() for shape in mi.load_string(eight, optimize=False).shapes()]
hold(kept == [f"c{i}" for i in range(8)], f"optimize=False gives {kept}")
print(f"eight named cubes: shapes {ids}, one parameter is", [k for k in keys if "faces" in k][0])
PY
