#!/usr/bin/env bash
# Mitsuba 3.9.1: a shape with a reflection, <scale x="-1"/>, in its to_world.
# Expected: a sphere mirrored at its centre's plane is the same sphere; or all shapes change alike.
# Seen: a sphere's normals point inwards. As a light it is black from outside, and so is a diffuse
# sphere in a white room. The same holds for a mesh from an OBJ or PLY file, but not if the file has
# vertex normals and they are used. A rectangle, a disk and a cube look as before.
# Do: take the reflection out of spheres and meshes, or add <boolean name="flip_normals" value="true"/>.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

printf '%s\n' 'v -1 -1 0' 'v 1 -1 0' 'v 1 1 0' 'v -1 1 0' 'f 1 2 3 4' > square.obj
sed 's/f .*/vn 0 0 1\nf 1\/\/1 2\/\/1 3\/\/1 4\/\/1/' square.obj > normals.obj
printf '%s\n' ply 'format ascii 1.0' 'element vertex 4' 'property float x' 'property float y' \
    'property float z' 'element face 2' 'property list uchar int vertex_indices' end_header \
    '-1 -1 0' '1 -1 0' '1 1 0' '-1 1 0' '3 0 1 2' '3 0 2 3' > square.ply
venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)

def mean(kind, x, inside, extra=""):
    scene = mi.load_string(f'''<scene version="3.0.0"><integrator type="path"/>
      <sensor type="perspective"><transform name="to_world">
        <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><float name="fov" value="5"/>
        <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
        <rfilter type="box"/></film></sensor>
      <shape type="{kind}"><transform name="to_world"><scale x="{x}"/></transform>{inside}</shape>
      {extra}</scene>''')
    return float(np.array(mi.render(scene, spp=64)).mean())

light = '<emitter type="area"><rgb name="radiance" value="1"/></emitter>'
wall, room = '<bsdf type="diffuse"/>', '<emitter type="constant"/>'
for kind in ("rectangle", "disk", "cube"):
    for x in (1, -1):
        hold(mean(kind, x, light) > 0.99, f"{kind} light with x scaled by {x} is dark")
        hold(mean(kind, x, wall, room) > 0.4, f"diffuse {kind} with x scaled by {x} is dark")
hold(mean("sphere", 1, light) > 0.99, "the plain sphere light is dark")
hold(mean("sphere", -1, light) == 0, "the mirrored sphere light shines outwards")
hold(mean("sphere", -1, wall, room) == 0, "the mirrored diffuse sphere is lit")
flip = '<boolean name="flip_normals" value="true"/>'
hold(mean("sphere", -1, flip + light) > 0.99, "flip_normals no longer repairs it")
def mesh(name, x, extra=""):
    return mean(name[-3:], x, f'<string name="filename" value="{name}"/>{extra}{light}')
face_normals = '<boolean name="face_normals" value="true"/>'
for name in ("square.obj", "square.ply"):
    for extra in ("", face_normals):
        hold(mesh(name, 1, extra) > 0.99, f"the plain light {name} is dark")
        hold(mesh(name, -1, extra) == 0, f"the mirrored light {name} shines to its front")
        hold(mesh(name, -1, extra + flip) > 0.99, f"flip_normals no longer repairs {name}")
hold(mesh("normals.obj", -1) > 0.99, "the mirrored light with vertex normals is dark")
hold(mesh("normals.obj", -1, face_normals) == 0, "face_normals: the mirrored light shines to its front")
print("mirrored sphere and meshes from files: black as lights; rectangle, disk and cube: as before")
PY
