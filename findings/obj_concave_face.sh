#!/usr/bin/env bash
# One concave quadrilateral in an OBJ file, read by trimesh 5.2.0, Mitsuba 3.9.1, three.js 0.170.0
# and tinyobjloader 2.0.0rc13.
# Expected: its area is 1, whichever corner the face starts with.
# Seen: the first three cut it into a fan from the first corner. "f 1 2 3 4" has area 1, "f 2 3 4 1"
# (the same polygon) has area 3: the notch is covered twice, by triangles that face opposite ways.
# tinyobjloader gets 1 for all starts. No reader says anything.
# Do: triangulate on export, or read concave faces with tinyobjloader.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with trimesh==5.2.0 mitsuba==3.9.1 tinyobjloader==2.0.0rc13 numpy==2.2.6
npm install --prefix "$tmp" --silent three@0.170.0 > npm.log

for start in "1 2 3 4" "2 3 4 1"; do
    printf 'v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf %s\n' "$start" > "face${start%% *}.obj"
done
cat > areas.mjs <<'JS'
import { readFileSync } from "node:fs";
import { Triangle } from "three";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
console.log(["face1.obj", "face2.obj"].map((name) => {
  const mesh = new OBJLoader().parse(readFileSync(name, "utf8")).children[0];
  const corners = mesh.geometry.attributes.position;
  let area = 0;
  for (let i = 0; i < corners.count; i += 3)
    area += new Triangle().setFromAttributeAndIndices(corners, i, i + 1, i + 2).getArea();
  return area;
}).join(" "));
JS
node areas.mjs > three.txt
venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np, tinyobjloader, trimesh
mi.set_variant("scalar_rgb")

def tiny(name):
    reader = tinyobjloader.ObjReader()
    reader.ParseFromFile(name)
    corners = np.array(reader.GetAttrib().vertices).reshape(-1, 3)
    index = np.array([i.vertex_index for i in reader.GetShapes()[0].mesh.indices]).reshape(-1, 3)
    a, b, c = corners[index].transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2

names = ("face1.obj", "face2.obj")
areas = {"trimesh": [trimesh.load(n).area for n in names],
         "Mitsuba": [mi.load_dict({"type": "obj", "filename": n}).surface_area() for n in names],
         "three.js": [float(x) for x in open("three.txt").read().split()],
         "tinyobjloader": [tiny(n) for n in names]}
for who, seen in areas.items():
    expected = (1, 1) if who == "tinyobjloader" else (1, 3)
    hold(np.allclose(seen, expected, atol=1e-4), f"{who} gets areas {seen}, not {expected}")
    print(f"{who}: area {seen[0]:.3f} from corner 1, {seen[1]:.3f} from corner 2")
PY
