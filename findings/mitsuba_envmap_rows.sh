#!/usr/bin/env bash
# Mitsuba 3.9.1: how much light a row of an environment map's texels gives.
# Expected: a map of 16 x 8 texels divides the sphere into 8 bands of equal height in angle, and
# a row with value 1 gives the solid angle of its band (interpolation only moves a little of it).
# Seen: the first and last rows lie exactly on the poles and the rest is stretched to fit, so row k
# of H is at the angle pi*k/(H-1). The first row gives 44 % of its band, rows beside the equator 112 %.
# At H = 512 the equator's rows still give 0.2 % more, and a sun is up to half a texel off.
# Do: use maps with many rows, and don't compare with renderers that sum over texel areas.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")

def row_light(height, row, steps=14308):
    """The row's radiance at each polar angle, and its integral over the sphere."""
    texels = np.zeros((height, 2 * height, 3), np.float32)
    texels[row] = 1
    light = mi.load_dict({"type": "envmap", "bitmap": mi.Bitmap(texels)})
    hit = mi.SurfaceInteraction3f()
    angles = (np.arange(steps) + 0.5) / steps * np.pi
    values = []
    for t in angles:
        hit.wi = mi.Vector3f(-np.sin(t), -np.cos(t), 0)
        values.append(light.eval(hit)[0])
    values = np.array(values)
    return angles[np.argmax(values)], 2 * np.pi * (values * np.sin(angles)).sum() * np.pi / steps

def ratio(height, row):
    band = 2 * np.pi * (np.cos(np.pi * row / height) - np.cos(np.pi * (row + 1) / height))
    peak, light = row_light(height, row)
    hold(abs(peak - np.pi * row / (height - 1)) < 2e-3, f"row {row} of {height} peaks at {peak}")
    return light / band

pole, equator, fine = ratio(8, 0), ratio(8, 3), ratio(512, 255)
hold(abs(pole - 0.436) < 0.005, f"row 0 of 8 gives {pole} of its band")
hold(abs(equator - 1.125) < 0.005, f"row 3 of 8 gives {equator} of its band")
hold(abs(fine - 1.002) < 0.0003, f"row 255 of 512 gives {fine} of its band")
print(f"light / band: row 0 of 8 {pole:.3f}, row 3 of 8 {equator:.3f}, row 255 of 512 {fine:.4f}")
PY
