#!/usr/bin/env bash
# OpenImageIO 3.2.2 and Mitsuba 3.9.1: negative values written to a Radiance .hdr file.
# Expected: RGBE has no sign, so they become 0.
# Seen: next to a brighter channel they wrap around to large positive ones: (-1, 0.5, 2) is read
# back as (3, 0.5, 2) and (-0.5, 1, 1) as (1.5, 1, 1), both from files of either library (on x86-64).
# Values near 0 do become 0: the error shows only at strongly negative pixels, as of Lanczos ringing
# or out-of-gamut colours, and is brighter than its surroundings.
# Do: clamp to 0 before writing .hdr.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import OpenImageIO as oiio, mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")
image = np.array([[[-1, 0.5, 2], [-0.5, 1, 1], [-0.001, 1, 1]]], np.float32)
expected = np.array([[[3, 0.5, 2], [1.5, 1, 1], [0, 1, 1]]], np.float32)
oiio.ImageBuf(image).write("a.hdr")
mi.Bitmap(image).write("b.hdr")
for name in ("a.hdr", "b.hdr"):
    for reader in (lambda n: oiio.ImageBuf(n).get_pixels(), lambda n: np.array(mi.Bitmap(n))):
        seen = reader(name)
        hold(np.allclose(seen, expected, atol=0.01), f"{name} is read as {seen.tolist()}")
print("written", image.tolist(), "read", seen.tolist())
PY
