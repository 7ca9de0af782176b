#!/usr/bin/env bash
# Mitsuba 3.9.1: a directional emitter whose to_world contains a scale.
# Expected: a direction has no length, so the irradiance stays what the scene says.
# Seen: the irradiance is multiplied by the scale: by 3 with <scale value="3"/>, by 0.01 with
# <scale value="0.01"/> (a scene in centimetres converted to metres loses its sun). The same sun given
# by <vector name="direction"> of any length is right, and a scale before the lookat acts as well.
# Do: give directional emitters a direction, or a to_world without scale.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")

def irradiance(direction):
    scene = mi.load_string(f'''<scene version="3.0.0"><integrator type="path"/>
      <sensor type="perspective"><transform name="to_world">
        <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><float name="fov" value="1"/>
        <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
        <rfilter type="box"/></film></sensor>
      <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></shape>
      <emitter type="directional">{direction}<rgb name="irradiance" value="1"/></emitter></scene>''')
    return float(np.array(mi.render(scene, spp=4)).mean() * np.pi)

look = '<lookat origin="0,0,1" target="0,0,0" up="0,1,0"/>'
to_world = lambda inside: irradiance(f'<transform name="to_world">{inside}</transform>')
vector = irradiance('<vector name="direction" x="0" y="0" z="-3"/>')
hold(abs(vector - 1) < 1e-3, f"direction of length 3: irradiance {vector}")
for inside, expected in ((look, 1), (look + '<scale value="3"/>', 3), ('<scale value="3"/>' + look, 3),
                         (look + '<scale value="0.01"/>', 0.01)):
    seen = to_world(inside)
    hold(abs(seen / expected - 1) < 1e-3, f"{inside}: irradiance {seen}, not {expected}")
    print(f"irradiance {seen:.4f} with {inside}")
PY
