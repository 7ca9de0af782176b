#!/usr/bin/env bash
# NumPy 2.2.6: generators seeded with lists, default_rng([seed, row, column]).
# Expected: lists that differ give streams that differ.
# Seen: a list is joined into one long number and filled up with zeros to 128 bits. So zeros at the end
# don't count: [7, 3, 0] is [7, 3], and [7, 0, 0] is 7. Pixel 0 of a row repeats the row's own stream.
# A number above 32 bits is several entries: 2^32 + 5 is [5, 1].
# Do: use lists of one fixed length with entries below 2^32, or SeedSequence(seed).spawn(n), which
# stays distinct.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import numpy as np

def same(a, b):
    return np.array_equal(*(np.random.default_rng(s).random(1000) for s in (a, b)))

for a, b in (([7, 3, 0], [7, 3]), ([7, 0, 0], 7), ([5, 1], 2**32 + 5)):
    hold(same(a, b), f"{a} and {b} now give different streams")
    print(f"{a} and {b}: the same stream")
for a, b in (([0, 7], 7), ([7, 0, 0, 0, 0], 7), ([7, 3, 1], [7, 3])):
    hold(not same(a, b), f"{a} and {b} now give the same stream")
    print(f"{a} and {b}: different streams")
root = np.random.SeedSequence(7)
hold(not any(same(child, 7) for child in root.spawn(3)), "a spawned stream is its parent's")
PY
