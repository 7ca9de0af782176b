#!/usr/bin/env bash
# Mitsuba 3.9.1: <rotate> about an axis whose length is not 1.
# Expected: the axis is a direction, so only its direction counts.
# Seen: it is used as it is. z="2" with 90 degrees also scales (x and y by 2, z by 4): a square of
# area 4 becomes one of area 16. x="1" y="1" shears it to an area of 11.3. Nothing is said.
# Do: give the axis with length 1.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi
mi.set_variant("scalar_rgb")

def area(axis):
    return mi.load_string(f'<shape version="3.0.0" type="rectangle"><transform name="to_world">'
                          f'<rotate {axis} angle="90"/></transform></shape>').surface_area()

one, two, diagonal = area('z="1"'), area('z="2"'), area('x="1" y="1"')
hold(abs(one - 4) < 1e-4, f"axis of length 1: area {one}, not 4")
hold(abs(two - 16) < 1e-3, f'axis z="2": area {two}, not 16')
hold(abs(diagonal - 8 * 2 ** 0.5) < 1e-3, f'axis x="1" y="1": area {diagonal}, not 11.31')
print(f"a square of area {one:.3f} turned about (0,0,2): {two:.3f}, about (1,1,0): {diagonal:.3f}")
PY
