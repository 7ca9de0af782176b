#!/usr/bin/env bash
# Mitsuba 3.9.1, variant scalar_rgb: <spectrum value="1"/> against <rgb value="1"/>.
# Expected: in a renderer that works in RGB both are white, (1, 1, 1), and both are checked alike.
# Seen: as a light's radiance the spectrum is (1.205, 0.948, 0.909), reddish: a flat spectrum seen
# by someone adapted to D65. As a reflectance both mean the same, but a reflectance of 2 is refused
# from <rgb> and accepted from <spectrum>: the surface then reflects twice what it gets.
# Do: write <rgb> when an RGB variant renders; keep <spectrum> for spectral variants.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")

def pixel(shape, rest=""):
    scene = mi.load_string(f'''<scene version="3.0.0"><integrator type="path"/>
      <sensor type="perspective"><transform name="to_world">
        <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><float name="fov" value="5"/>
        <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
        <rfilter type="box"/></film></sensor>
      <shape type="rectangle">{shape}</shape>{rest}</scene>''')
    return np.array(mi.render(scene, spp=1024)).mean((0, 1))

light = lambda x: pixel(f'<emitter type="area">{x}</emitter>')
wall = lambda x: pixel(f'<bsdf type="diffuse">{x}</bsdf>',
                       '<emitter type="constant"><rgb name="radiance" value="1"/></emitter>')
red = light('<spectrum name="radiance" value="1"/>')
hold(np.allclose(light('<rgb name="radiance" value="1"/>'), 1, atol=1e-4), "rgb light is not white")
hold(np.allclose(red, (1.205, 0.948, 0.909), atol=2e-3), f"spectrum light is {red}")
grey = wall('<spectrum name="reflectance" value="1"/>') / wall('<rgb name="reflectance" value="1"/>')
hold(np.allclose(grey, 1, atol=1e-4), f"reflectance 1: spectrum/rgb is {grey}")
double = wall('<spectrum name="reflectance" value="2"/>')
hold(double.min() > 1.9, f"spectrum reflectance 2 reflects {double}")
try:
    wall('<rgb name="reflectance" value="2"/>')
    hold(False, "rgb reflectance 2 is accepted")
except RuntimeError:
    pass
print(f"light {red.round(3)}, a wall of reflectance 2 in a white room: {double.round(2)}")
PY
