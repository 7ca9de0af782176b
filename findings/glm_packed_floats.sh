#!/usr/bin/env bash
# GLM 0.9.9.8 (Debian libglm-dev): glm::packF2x11_1x10 (11 and 10 bit floats, R11G11B10F) and
# packF3x9_E1x5 (RGB9E5), each unpacked again.
# Expected: values too small become 0, values too large the largest, and there is no sign.
# Seen: from 11 bits, 3e-5 comes back as 128000, 1e-8 as 42.5 and 1e6 as 0.00023 (exponents wrap
# around), -1 as 1. From RGB9E5 nothing above 32768 comes back, though the format goes to 65408, so
# (65408, 32704, 0) becomes (32768, 32768, 0): the colour changes too.
# Do: clamp to [2^-14, 65024] or exactly 0 before the first, to 32768 before the second.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
debian_with libglm-dev=0.9.9.8+ds-6

cat > packed.cpp <<'CPP'
#include <cmath>
#include <initializer_list>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include "hold.h"

int main() {
    struct Case { float given, seen; };
    for (Case c : {Case{0.5f, 0.5f}, {0.0f, 0.0f}, {3e-5f, 128000.0f}, {1e-8f, 42.5f},
                   {1e6f, 0.000232697f}, {-1.0f, 1.0f}}) {
        float back = glm::unpackF2x11_1x10(glm::packF2x11_1x10(glm::vec3(c.given))).x;
        std::printf("11 bits: %g comes back as %g\n", c.given, back);
        hold(std::abs(back - c.seen) <= 1e-5f * c.seen, "packF2x11_1x10");
    }
    for (float given : {0.5f, 32768.0f, 40000.0f, 65408.0f}) {
        auto back = glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::vec3(given, given / 2, 0)));
        std::printf("RGB9E5: (%g, %g, 0) comes back as (%g, %g, 0)\n", given, given / 2, back.x, back.y);
        hold(back.x == std::fmin(given, 32768.0f), "packF3x9_E1x5");
    }
}
CPP
g++ -std=c++17 -O1 -Iroot/usr/include packed.cpp -o packed
./packed
