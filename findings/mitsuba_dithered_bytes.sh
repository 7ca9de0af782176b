#!/usr/bin/env bash
# Mitsuba 3.9.1: Bitmap.convert from float to UInt8, which write_bitmap uses for a PNG.
# Expected: value x 255, rounded: a picture of one grey gives one number.
# Seen: a fixed pattern is added before rounding. A constant 0.5 becomes 127 in half of the pixels and
# 128 in the others, 0.25 becomes 63 in a quarter and 64 in the rest; the means are right. So a
# picture differs by 1 from other programs', and equal pixels differ among themselves.
# Do: for exact bytes, round with NumPy and give Bitmap the uint8 array; compare with a tolerance of 1.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")

def to_bytes(value):
    picture = mi.Bitmap(np.full((64, 64, 3), value, np.float32))
    return np.array(picture.convert(component_format=mi.Struct.Type.UInt8, srgb_gamma=False))

for value, low, share in ((0.5, 127, 0.5), (0.25, 63, 0.25), (0.2, 51, 1)):
    seen, counts = np.unique(to_bytes(value), return_counts=True)
    print(f"{value} becomes {dict(zip(seen.tolist(), counts.tolist()))}, mean {to_bytes(value).mean():.3f}")
    hold(seen[0] == low and abs(counts[0] / counts.sum() - share) < 0.02, f"{value} becomes {seen}, {counts}")
    hold(abs(to_bytes(value).mean() - value * 255) < 0.01, f"the mean of {value}")
    hold(np.array_equal(to_bytes(value), to_bytes(value)), "the pattern changes from call to call")
PY
