#!/usr/bin/env bash
# Converting to 16-bit floats: GLM 0.9.9.8 (Debian libglm-dev), three.js 0.170.0, NumPy 2.2.6.
# Expected: the nearest half; halfway, the one with an even last bit (as the hardware does).
# Seen: between 2048 and 2050, and 2050 and 2052, where halves are 2 apart:
#            2049   2051   2051.99
#   NumPy    2048   2052   2052      nearest, ties to even
#   GLM      2050   2052   2052      nearest, ties away from 0 (packHalf1x16)
#   three    2048   2050   2050      towards 0 (DataUtils.toHalfFloat): on average half a step low
# And three.js turns infinity into 65504.
# Do: don't compare such files bit by bit; where means matter, don't convert with toHalfFloat.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with numpy==2.2.6
npm install --prefix "$tmp" --silent three@0.170.0 > npm.log
debian_with libglm-dev=0.9.9.8+ds-6

cat > half.cpp <<'CPP'
#include <cstdio>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
int main() {
    const float values[] = {2049.0f, 2051.0f, 2051.99f};
    for (float v : values) std::printf("%g ", glm::unpackHalf1x16(glm::packHalf1x16(v)));
}
CPP
g++ -std=c++17 -O1 -Iroot/usr/include half.cpp -o half
./half > glm.txt
cat > half.mjs <<'JS'
import { DataUtils as D } from "three";
console.log([2049, 2051, 2051.99, 65504].map((v) => D.fromHalfFloat(D.toHalfFloat(v))).join(" "));
console.log(D.fromHalfFloat(D.toHalfFloat(Infinity)));
JS
node half.mjs > three.txt 2> warnings.txt
venv/bin/python - <<'PY'
from hold import hold
import numpy as np
seen = {"NumPy": np.array([2049, 2051, 2051.99], np.float32).astype(np.float16).tolist(),
        "GLM": [float(x) for x in open("glm.txt").read().split()]}
three = [float(x) for x in open("three.txt").read().split()]
seen["three.js"], infinity = three[:3], three[4]
for who, expected in (("NumPy", [2048, 2052, 2052]), ("GLM", [2050, 2052, 2052]),
                      ("three.js", [2048, 2050, 2050])):
    print(f"{who}: 2049, 2051, 2051.99 become {seen[who]}")
    hold(seen[who] == expected, f"{who} gives {seen[who]}, not {expected}")
hold(infinity == 65504, f"three.js turns infinity into {infinity}")
PY
