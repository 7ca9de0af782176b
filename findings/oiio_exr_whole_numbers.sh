#!/usr/bin/env bash
# OpenImageIO 3.2.2: an OpenEXR file whose channels are unsigned 32-bit integers, read as floats.
# Expected: 1 is 1, as the format has it (integers hold counts and ids), and as Mitsuba 3.9.1 reads it.
# Seen: integers become fractions of the largest, as in PNG: 1 comes back as 2.3e-10, 1000000 as 0.00023.
# Such a picture is black, without a message.
# Do: look at the channel's format first, and read integers as integers.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 OpenEXR==3.5.3 mitsuba==3.9.1 numpy==2.2.6
venv/bin/python - <<'PY'
from hold import hold
import OpenEXR, OpenImageIO as oiio, mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")
counts = np.array([[0, 1], [1000000, 2 ** 32 - 1]], np.uint32)
header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
OpenEXR.File(header, {c: counts for c in "RGB"}).write("counts.exr")
seen = oiio.ImageBuf("counts.exr").get_pixels(oiio.FLOAT)[..., 0]
hold(np.allclose(seen, counts / (2 ** 32 - 1), rtol=1e-6, atol=0), f"as floats: {seen.tolist()}")
whole = oiio.ImageBuf("counts.exr").get_pixels(oiio.UINT32)[..., 0]
hold(np.array_equal(whole, counts), f"as integers: {whole.tolist()}")
floats = mi.Bitmap("counts.exr").convert(component_format=mi.Struct.Type.Float32)
hold(np.array_equal(np.array(floats)[..., 0], counts.astype(np.float32)), "Mitsuba's floats")
print(f"{counts.ravel().tolist()} become {seen.ravel().tolist()}")
PY
