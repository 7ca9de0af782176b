#!/usr/bin/env bash
# OpenImageIO 3.2.2 (PyPI): writing a PFM image and reading it again.
# Expected: the same image.
# Seen: it comes back upside down. The file is right (PFM stores the bottom row first, and the
# writer does), but the reader gives the file's first row as row 0 unless asked otherwise. Other
# programs' PFM files are read upside down as well. Mitsuba 3.9.1 reads the same file upright.
# Do: open PFM with a configuration that has "pnm:pfmflip" set to 1.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 mitsuba==3.9.1 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import OpenImageIO as oiio, mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")
image = np.zeros((2, 2, 3), np.float32)
image[0], image[1] = 1, 2
oiio.ImageBuf(image).write("image.pfm")

first = np.frombuffer(open("image.pfm", "rb").read()[-48:], "<f4")[0]
hold(first == 2, f"the file's first value is {first}: not the bottom row's")
back = oiio.ImageBuf("image.pfm").get_pixels()
hold(np.array_equal(back, image[::-1]), f"rows read back: {back[:, 0, 0]}")
config = oiio.ImageSpec()
config.attribute("pnm:pfmflip", 1)
asked = oiio.ImageInput.open("image.pfm", config).read_image()
hold(np.array_equal(asked, image), f"rows with pnm:pfmflip: {asked[:, 0, 0]}")
other = np.array(mi.Bitmap("image.pfm"))
hold(np.array_equal(other, image), f"Mitsuba's rows: {other[:, 0, 0]}")
print("rows written 1, 2; read back", back[:, 0, 0], "with pnm:pfmflip", asked[:, 0, 0])
PY
