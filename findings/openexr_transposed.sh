#!/usr/bin/env bash
# OpenEXR 3.5.3 (PyPI): writing a transposed NumPy array.
# Expected: the picture that the array shows, or an error.
# Seen: the strides are ignored: the file holds the array's memory in its order in memory, cut into
# rows of the new width. A 6 x 4 picture transposed to 4 x 6 comes out scrambled, without a message.
# Do: pass np.ascontiguousarray(array) whenever it comes from a transpose, a slice or a flip.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenEXR==3.5.3 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import OpenEXR, numpy as np

def through_file(array):
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"Y": array}).write("image.exr")
    return OpenEXR.File("image.exr").channels()["Y"].pixels

picture = np.arange(24, dtype=np.float32).reshape(6, 4).T
seen = through_file(picture)
hold(seen.shape == (4, 6), f"shape {seen.shape}")
hold(not np.array_equal(seen, picture), "the transposed array is written right")
hold(np.array_equal(seen.ravel(), np.arange(24)), f"row 0 is {seen[0]}")
copy = through_file(np.ascontiguousarray(picture))
hold(np.array_equal(copy, picture), "a contiguous copy is written wrong")
print("row 0 given", picture[0], "row 0 in the file", seen[0])
PY
