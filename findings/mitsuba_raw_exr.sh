#!/usr/bin/env bash
# Mitsuba 3.9.1: a bitmap texture of an EXR file with raw=true, as for normals and roughness.
# Expected: raw values are the file's values.
# Seen: raw does not stop two conversions. Channels named X, Y, Z (the usual names for vectors) are
# taken for CIE colours: (0.25, 0.5, 0.75) becomes (-0.33, 0.73, 0.70). An R, G, B file that states
# the ACES AP0 primaries is converted on loading: (-0.21, 0.54, 0.73), and the result no longer says
# where it came from. OpenImageIO 3.2.2 gives the file's values in both cases.
# Do: name data channels R, G, B and write no chromaticities into data files.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with mitsuba==3.9.1 numpy==2.2.6 OpenEXR==3.5.3 OpenImageIO==3.2.2.0

venv/bin/python - <<'PY'
from hold import hold
import mitsuba as mi, numpy as np, OpenEXR, OpenImageIO
mi.set_variant("scalar_rgb")
values = np.array([0.25, 0.5, 0.75])
ap0 = (0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767)

def write(name, channels, **header):
    header |= {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {c: np.full((4, 6), v, np.float32) for c, v in zip(channels, values)}).write(name)

write("plain.exr", "RGB")
write("vector.exr", "XYZ")
write("aces.exr", "RGB", chromaticities=ap0)
seen = {}
for name in ("plain", "vector", "aces"):
    texture = mi.load_dict({"type": "bitmap", "filename": f"{name}.exr", "raw": True})
    seen[name] = np.array(mi.traverse(texture)["data"].array).reshape(-1, 3)[0]
    other = OpenImageIO.ImageBuf(f"{name}.exr").get_pixels()[0, 0]
    hold(np.allclose(other, values), f"OpenImageIO reads {name}.exr as {other}")
hold(np.allclose(seen["plain"], values, atol=1e-4), f"plain R, G, B: {seen['plain']}")
hold(np.allclose(seen["vector"], (-0.332, 0.727, 0.705), atol=2e-3), f"X, Y, Z: {seen['vector']}")
hold(np.allclose(seen["aces"], (-0.214, 0.543, 0.732), atol=2e-3), f"AP0: {seen['aces']}")
print(f"raw textures of {values}: X,Y,Z {seen['vector'].round(3)}, AP0 {seen['aces'].round(3)}")
PY
