#!/usr/bin/env bash
# OpenImageIO 3.2.2 (PyPI): ImageBufAlgo.compare of an image against one with NaN or infinity.
# Expected: the pixel fails.
# Seen: mean error 0, RMS error 0, PSNR infinite, no failing pixel, no error: a test passes. Only
# maxerror says infinity, and if both images are NaN there, not even that. Infinity against 1 passes too.
# Do: also require a finite maxerror, and ask computePixelStats for its nancount and infcount.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import OpenImageIO as oiio, numpy as np

def compare(a, b):
    image = lambda values: oiio.ImageBuf(np.array([[[v] for v in values]], np.float32))
    return oiio.ImageBufAlgo.compare(image(a), image(b), 1e-3, 1e-3)

hold(compare((1, 2), (1.1, 2)).nfail == 1, "a difference of 0.1 passes")
nan, inf = float("nan"), float("inf")
for a, b, largest in (((1, 2), (nan, 2), inf), ((nan, 2), (1, 2), inf), ((inf, 2), (1, 2), inf),
                      ((nan, 2), (nan, 2), 0)):
    r = compare(a, b)
    hold(r.nfail == 0 and not r.error and r.meanerror == 0 and r.rms_error == 0,
         f"{a} against {b}: {r.nfail} failing, mean error {r.meanerror}")
    hold(r.maxerror == largest, f"{a} against {b}: maxerror {r.maxerror}")
    print(f"{a} against {b}: failing pixels {r.nfail}, mean error {r.meanerror}, maxerror {r.maxerror}")
PY
