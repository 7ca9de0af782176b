#!/usr/bin/env bash
# OpenColorIO 2.6.0 (PyPI): a gamma curve on the CPU with getDefaultCPUProcessor().
# Expected: float accuracy, errors about 1e-7, and white stays white.
# Seen: the default optimisations replace pow, log and exp by fast approximations. A gamma of 2.2 is
# up to 2e-5 off, a hundred times as much, and 1.0 becomes 1.00002, which a test for values <= 1 sees.
# An image that went through a curve there thus differs from one that any other program made.
# Do: getOptimizedCPUProcessor(OPTIMIZATION_LOSSLESS), or compare with a tolerance of 1e-4.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with opencolorio==2.6.0 numpy==2.2.6

venv/bin/python - <<'PY'
from hold import hold
import PyOpenColorIO as ocio, numpy as np

curve = ocio.Config.CreateRaw().getProcessor(ocio.ExponentTransform([2.2, 2.2, 2.2, 1]))
x = np.linspace(0.01, 1, 3000, dtype=np.float32)
def errors(cpu):
    y = x.reshape(-1, 3).copy()
    cpu.applyRGB(y)
    return y.ravel(), np.abs(y.ravel() / x.astype(np.float64) ** 2.2 - 1).max()

y, fast = errors(curve.getDefaultCPUProcessor())
z, exact = errors(curve.getOptimizedCPUProcessor(ocio.OPTIMIZATION_LOSSLESS))
print(f"largest relative error: default {fast:.1e}, lossless {exact:.1e}; white: {y[-1]:.7f}, {z[-1]:.7f}")
hold(1e-5 < fast < 5e-5, f"the default's error is {fast}")
hold(exact < 1e-6, f"the lossless processor's error is {exact}")
hold(y[-1] > 1 and z[-1] == 1, f"white becomes {y[-1]} by default, {z[-1]} lossless")
PY
