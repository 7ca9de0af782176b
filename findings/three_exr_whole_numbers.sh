#!/usr/bin/env bash
# three.js 0.170.0, EXRLoader: an OpenEXR file with R, G, B as floats and one more channel of 32-bit whole numbers.
# Expected: as without that channel, which is left out: R, G, B are 1, 2, 3, as OpenEXR 3.5.3 reads them.
# Seen: (9.8e-45, 1, 2), without a message: whole numbers are taken to need no bytes, so that each channel after
# them is read too early; the first is the bits of the whole number, 7. A fourth channel of floats changes nothing.
# Do: give three.js a copy with R, G, B alone.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenEXR==3.5.3 numpy==2.2.6
npm install --prefix "$tmp" --silent three@0.170.0 > npm.log

venv/bin/python - <<'PY'
from hold import hold
import OpenEXR, numpy as np
for name, extra in {"plain": None, "float": np.float32, "whole": np.uint32}.items():
    channels = {c: np.full((4, 4), i + 1, np.float32) for i, c in enumerate("RGB")}
    if extra: channels["id"] = np.full((4, 4), 7, extra)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, channels).write(name + ".exr")
    read = OpenEXR.File(name + ".exr", separate_channels=True).channels()
    hold([read[c].pixels[0, 0] for c in "RGB"] == [1, 2, 3], "OpenEXR's colours")
PY
cat > read.mjs <<'JS'
import { readFileSync } from "node:fs";
import { FloatType } from "three";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
for (const name of ["plain", "float", "whole"]) {
  const bytes = new Uint8Array(readFileSync(name + ".exr"));
  const seen = new EXRLoader().setDataType(FloatType).parse(bytes.buffer).data.slice(0, 3);
  console.log(name + ": " + Array.from(seen).join(" "));
}
JS
node read.mjs | tee three.txt
grep -qx 'plain: 1 2 3' three.txt && grep -qx 'float: 1 2 3' three.txt || { echo 'changed: files without whole numbers'; exit 1; }
grep -q '^whole: 9\.8.*e-45 1 2$' three.txt || { echo 'changed: a file with whole numbers'; exit 1; }
