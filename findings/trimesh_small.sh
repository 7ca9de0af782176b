#!/usr/bin/env bash
# trimesh 5.2.0: a cube with a very short edge (a model in metres of something microscopic).
# Expected: the same shape at another scale.
# Seen: there are fixed lengths inside. Edge 1e-6: a good cube. Edge 1e-7: watertight, volume right,
# but all face normals are (0, 0, 0). Edge 1e-8: all corners are merged into one, area 0.
# Do: scale such models up before trimesh gets them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with trimesh==5.2.0 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import numpy as np, trimesh
cube = trimesh.creation.box()

def scaled(edge):
    mesh = trimesh.Trimesh(cube.vertices * edge, cube.faces)
    length = np.linalg.norm(mesh.face_normals, axis=1).max()
    print(f"edge {edge}: {len(mesh.vertices)} corners, area/edge^2 {mesh.area / edge**2:.3f}, "
          f"longest normal {length:.3f}, watertight {mesh.is_watertight}")
    return len(mesh.vertices), round(mesh.area / edge**2, 6), round(float(length), 6), mesh.is_watertight

hold(scaled(1e-6) == (8, 6, 1, True), "edge 1e-6 is no longer a good cube")
hold(scaled(1e-7) == (8, 6, 0, True), "edge 1e-7 no longer has zero normals")
hold(scaled(1e-8)[:2] == (1, 0), "edge 1e-8 no longer collapses")
PY
