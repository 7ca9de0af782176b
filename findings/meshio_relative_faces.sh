#!/usr/bin/env bash
# meshio 5.3.5: an OBJ file with relative vertex numbers (-1 is the latest vertex).
# Expected: "f -3 -2 -1" after four vertices is the triangle of the last three, as in trimesh 5.2.0.
# Seen: 1 is subtracted as from absolute numbers, so the triangle is (-4, -3, -2). NumPy counts
# negative indices from the end: points[cells] works and is the vertex before, in every corner, and the
# wrong mesh is saved. In a file that writes faces between its vertices it is any other vertex.
# Do: convert to absolute numbers first, or check that no index is negative.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with meshio==5.3.5 trimesh==5.2.0 numpy==2.2.6

printf 'v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n' > relative.obj
venv/bin/python - <<'PY'
from hold import hold
import meshio, trimesh

mesh = meshio.read("relative.obj")
cells = mesh.cells_dict["triangle"]
corners = mesh.points[cells[0]].tolist()
right = trimesh.load("relative.obj", process=False).triangles[0].tolist()
print("meshio:", cells.tolist(), corners, "trimesh:", right)
hold(right == [[0, 0, 0], [1, 0, 0], [0, 1, 0]], f"trimesh reads {right}")
hold(cells.tolist() == [[-4, -3, -2]], f"meshio reads the face {cells.tolist()}")
hold(corners == [[9, 9, 9], [0, 0, 0], [1, 0, 0]], f"meshio's corners are {corners}")
PY
