#!/usr/bin/env bash
# Two pieces of valid OBJ: a face continued on the next line with "\", and relative vertex numbers
# (-1 is the latest). Read by trimesh 5.2.0, Mitsuba 3.9.1, tinyobjloader 2.0.0rc13.
# Expected: all read both.
# Seen, continued face: Mitsuba loads a mesh with 0 faces, tinyobjloader fails and complains
# about a zero index that is not there, trimesh reads it. Relative numbers: Mitsuba fails
# with "invalid vertex 4294967292", the others read them.
# Do: join continued lines and make the numbers absolute before other programs get the file.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with trimesh==5.2.0 mitsuba==3.9.1 tinyobjloader==2.0.0rc13 numpy==2.2.6

corners='v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n'
printf '%b' "$corners"'f 1 2 \\\n 3 4\n' > continued.obj
printf '%b' "$corners"'f -4 -3 -2 -1\n' > relative.obj
venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, tinyobjloader, trimesh
mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)

def mitsuba(name):
    try:
        return mi.load_dict({"type": "obj", "filename": name}).face_count()
    except RuntimeError as error:
        return "fails: " + str(error).rsplit(": ", 1)[-1]

def tiny(name):
    reader = tinyobjloader.ObjReader()
    if not reader.ParseFromFile(name):
        return "fails: " + reader.Error().split(" (")[0]
    return len(reader.GetShapes()[0].mesh.num_face_vertices)

seen = {(reader.__name__, name): reader(name + ".obj") for name in ("continued", "relative")
        for reader in (mitsuba, tiny)}
for name in ("continued", "relative"):
    seen["trimesh", name] = len(trimesh.load(name + ".obj").faces)
for key, value in seen.items():
    print(*key, value)
hold(seen["mitsuba", "continued"] == 0, "Mitsuba and a continued face")
hold("4294967292" in str(seen["mitsuba", "relative"]), "Mitsuba and relative numbers")
hold("fails" in str(seen["tiny", "continued"]), "tinyobjloader and a continued face")
hold(seen["tiny", "relative"] == 2, "tinyobjloader and relative numbers")
hold(seen["trimesh", "continued"] == 2 and seen["trimesh", "relative"] == 2, "trimesh")
PY
