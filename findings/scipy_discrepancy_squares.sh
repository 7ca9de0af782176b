#!/usr/bin/env bash
# SciPy 1.15.3: qmc.discrepancy with its four methods.
# Expected: four distances of the same kind; for random points each falls as 1/sqrt(n).
# Seen: CD, WD and MD are squares, only L2-star has its root taken. 64 times as many random points
# divide CD, WD and MD by about 64 and L2-star by about 8, which looks like the rate of a
# low-discrepancy set. Two points at 1/2 have CD = 1/12 and L2-star = sqrt(1/12), though
# both definitions agree there.
# Do: take the square root of CD, WD and MD before rates or values are compared.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with scipy==1.15.3 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import numpy as np
from scipy.stats import qmc

middle = [[0.5], [0.5]]
for method, value in (("CD", 1 / 12), ("L2-star", (1 / 12) ** 0.5)):
    seen = qmc.discrepancy(middle, method=method)
    hold(abs(seen - value) < 1e-12, f"{method} of two points at 1/2 is {seen}, not {value}")

def mean(method, n):
    return np.mean([qmc.discrepancy(np.random.default_rng(seed).random((n, 2)), method=method)
                    for seed in range(40)])

for method, low, high in (("CD", 45, 90), ("WD", 45, 90), ("MD", 45, 90), ("L2-star", 6, 11)):
    ratio = mean(method, 16) / mean(method, 1024)
    print(f"{method}: 64 times as many random points divide it by {ratio:.1f}")
    hold(low < ratio < high, f"{method} is divided by {ratio}")
PY
