#!/usr/bin/env bash
# OpenCV 4.13.0 and 5.0.0 (PyPI): warpAffine and remap of float images with INTER_LINEAR.
# Expected: a picture is moved by the distance given.
# Seen: 4.13.0 rounds coordinates to 1/32 of a pixel, though image and coordinates are floats. A shift of
# 0.01 pixels does nothing, one of 0.02 is 1/32; reprojected or undistorted pictures are up to
# 1/64 pixel off, and coordinates that vary slowly give steps. 5.0.0 is exact.
# Do: update to 5, or interpolate yourself where sub-pixel positions count.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cat > shift.py <<'PY'
from hold import hold
import cv2, numpy as np

ramp = np.tile(np.arange(64, dtype=np.float32), (64, 1))  # each pixel's value is its x
def moved(shift):
    return (cv2.warpAffine(ramp, np.float32([[1, 0, -shift], [0, 1, 0]]), (64, 64)) - ramp)[20, 20]

x = np.random.default_rng(1).uniform(5, 50, (64, 64)).astype(np.float32)
error = np.abs(cv2.remap(ramp, x, np.full_like(x, 20), cv2.INTER_LINEAR) - x).max()
print(f"OpenCV {cv2.__version__}: shifts of 0.01 and 0.02 move {moved(0.01):.5f} and {moved(0.02):.5f}, "
      f"remap is up to {error:.5f} off")
if cv2.__version__.startswith("4"):
    hold(moved(0.01) == 0 and moved(0.02) == 1 / 32, "warpAffine in 4.13 is no longer in steps of 1/32")
    hold(0.015 < error <= 1 / 64 + 1e-5, "remap in 4.13 is no longer in steps of 1/32")
else:
    hold(abs(moved(0.01) - 0.01) < 1e-5 and abs(moved(0.02) - 0.02) < 1e-5, "warpAffine in 5 is not exact")
    hold(error < 1e-5, "remap in 5 is not exact")
PY
for version in 4.13.0.92 5.0.0.93; do
    python_with opencv-python-headless==$version numpy==2.2.6
    venv/bin/python shift.py
done
