#!/usr/bin/env bash
# The third line of a PFM file, -3.0 for instance: its sign is the byte order, its magnitude a scale.
# Read by OpenImageIO 3.2.2, Mitsuba 3.9.1, OpenCV 5.0.0 and Pillow 12.0.0.
# Expected: one meaning of the scale.
# Seen: a stored 1.0 is 3 in OpenImageIO and Mitsuba, 1/3 in OpenCV and 1 in Pillow.
# Do: write only 1.0 or -1.0 there; on reading, look at the line and scale the values yourself.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 mitsuba==3.9.1 opencv-python-headless==5.0.0.93 pillow==12.0.0 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import cv2, mitsuba as mi, numpy as np, OpenImageIO as oiio
from PIL import Image
mi.set_variant("scalar_rgb")

readers = {"OpenImageIO": (3, lambda name: oiio.ImageBuf(name).get_pixels(oiio.FLOAT)),
           "Mitsuba": (3, lambda name: mi.Bitmap(name)),
           "OpenCV": (1 / 3, lambda name: cv2.imread(name, cv2.IMREAD_UNCHANGED)),
           "Pillow": (1, Image.open)}
for scale in (1, 3):
    with open(f"scale{scale}.pfm", "wb") as file:
        file.write(b"Pf\n2 2\n-%d.0\n" % scale + np.ones(4, "<f4").tobytes())
for who, (expected, read) in readers.items():
    plain, scaled = (float(np.asarray(read(f"scale{s}.pfm")).flat[0]) for s in (1, 3))
    print(f"{who}: a stored 1.0 is {plain:g} with scale 1, {scaled:.4g} with scale 3")
    hold(plain == 1, f"{who} reads {plain} with scale 1")
    hold(abs(scaled - expected) < 1e-6, f"{who} reads {scaled} with scale 3")
PY
