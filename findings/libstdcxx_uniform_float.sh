#!/usr/bin/env bash
# libstdc++ of GCC 12.2 (the g++ found on the machine): std::uniform_real_distribution<float>(1, 2).
# Expected: numbers in [1, 2), as for (0, 1), where the library takes care that 1 never comes.
# Seen: that care is taken before scaling: the largest number, 1 - 2^-24, plus 1 rounds to 2. With
# std::mt19937 the bound came 8 times in 50 million numbers, and for (16, 17) 54 times.
# Do: std::min(u, std::nextafter(b, a)) where the upper bound must not come.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

cat > uniform.cpp <<'CPP'
#include <random>
#include "hold.h"
struct Largest {
    using result_type = unsigned;
    static constexpr unsigned min() { return 0; }
    static constexpr unsigned max() { return 0xffffffffu; }
    unsigned operator()() { return 0xffffffffu; }
};
long hits(float a, float b, long numbers) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(a, b);
    long n = 0;
    for (long i = 0; i < numbers; ++i) n += uniform(engine) >= b;
    std::printf("(%g, %g): the upper bound came %ld times in %ld\n", a, b, n, numbers);
    return n;
}
int main() {
    Largest engine;
    hold(std::uniform_real_distribution<float>(0, 1)(engine) < 1, "(0, 1) gives 1");
    hold(std::uniform_real_distribution<float>(1, 2)(engine) == 2, "(1, 2) no longer gives 2");
    hold(hits(0, 1, 50000000) == 0, "(0, 1) gives 1");
    hold(hits(1, 2, 50000000) > 0, "(1, 2) no longer gives 2");
    hold(hits(16, 17, 50000000) > 10, "(16, 17) no longer gives 17");
}
CPP
g++ -std=c++17 -O2 uniform.cpp -o uniform
./uniform
