#!/usr/bin/env bash
# libstdc++ of GCC 12.2 (the g++ found on the machine): std::assoc_legendre and std::sph_legendre, for
# spherical harmonics as in environment lighting.
# Expected: sph_legendre(l, m, theta) is assoc_legendre(l, m, cos(theta)) times a positive normalisation.
# Seen: only sph_legendre has the phase (-1)^m, so the two differ in sign for every odd m. The C++
# standard defines them so. SciPy 1.15.3's sph_harm_y has the phase like sph_legendre.
# Do: take all values from one of them; coefficients from the other need (-1)^m.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
python_with scipy==1.15.3 numpy==2.2.6

cat > legendre.cpp <<'CPP'
#include <cmath>
#include "hold.h"
int main() {
    const double theta = 1.1;
    for (unsigned l = 0; l < 5; ++l) {
        for (unsigned m = 0; m <= l; ++m) {
            const double ratio = std::tgamma(l - m + 1) / std::tgamma(l + m + 1);
            const double norm = std::sqrt((2 * l + 1) / (4 * M_PI) * ratio);
            const double sph = std::sph_legendre(l, m, theta);
            const double assoc = std::assoc_legendre(l, m, std::cos(theta));
            hold(std::fabs(sph - (m % 2 ? -1 : 1) * norm * assoc) < 1e-12, "the phase of sph_legendre");
            std::printf("%u %u %.17g\n", l, m, sph);
        }
    }
}
CPP
g++ -std=c++17 -O1 legendre.cpp -o legendre
./legendre > sph.txt
venv/bin/python - <<'PY'
from hold import hold
from scipy.special import sph_harm_y
for line in open("sph.txt"):
    l, m, value = line.split()
    scipys = sph_harm_y(int(l), int(m), 1.1, 0).real
    hold(abs(scipys - float(value)) < 1e-12, f"SciPy's sph_harm_y({l}, {m}) is {scipys}, not {value}")
print("sph_legendre = (-1)^m norm assoc_legendre = SciPy's sph_harm_y, for l < 5")
PY
