#!/usr/bin/env bash
# three.js 0.170.0, RGBELoader: the value of a Radiance .hdr pixel, with FloatType.
# Expected: bytes (128, 128, 128, 129) are 1.0: a mantissa is divided by 256, an exponent of 128 is 2^0.
# Seen: 1.0039. Mantissas are divided by 255, so every picture is 0.4 % brighter than in
# OpenImageIO 3.2.2, which gives 1.0. A file that says FORMAT=32-bit_rle_xyze (CIE XYZ) is
# taken for RGB without a word; OpenImageIO refuses it.
# Do: multiply by 255/256 when comparing numbers, and check FORMAT before loading.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with OpenImageIO==3.2.2.0 numpy==2.2.6
npm install --prefix "$tmp" --silent three@0.170.0 > npm.log

for format in rgbe xyze; do
    printf '#?RADIANCE\nFORMAT=32-bit_rle_%s\n\n-Y 1 +X 4\n' "$format" > "$format.hdr"
    for _ in 1 2 3 4; do printf '\200\200\200\201'; done >> "$format.hdr"
done
cat > read.mjs <<'JS'
import { readFileSync } from "node:fs";
import { FloatType } from "three";
import { RGBELoader } from "three/examples/jsm/loaders/RGBELoader.js";
for (const name of ["rgbe.hdr", "xyze.hdr"]) {
  const bytes = new Uint8Array(readFileSync(name));
  console.log(new RGBELoader().setDataType(FloatType).parse(bytes.buffer).data[0]);
}
JS
node read.mjs > three.txt
venv/bin/python - <<'PY'
from hold import hold
import OpenImageIO as oiio
rgbe, xyze = (float(line) for line in open("three.txt"))
other = oiio.ImageBuf("rgbe.hdr").get_pixels()[0, 0, 0]
hold(abs(rgbe - 256 / 255) < 1e-6, f"three.js reads {rgbe}, not 1.0039")
hold(xyze == rgbe, f"three.js reads {xyze} from the XYZ file")
hold(other == 1, f"OpenImageIO reads {other}")
hold(oiio.ImageInput.open("xyze.hdr") is None, "OpenImageIO opens the XYZ file")
oiio.geterror()  # fetched, or it is printed at the end
print(f"three.js {rgbe:.5f} (XYZ file {xyze:.5f}), OpenImageIO {other}")
PY
