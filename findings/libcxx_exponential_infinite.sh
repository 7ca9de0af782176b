#!/usr/bin/env bash
# libc++ 14.0.6 (Debian libc++-14-dev, built with the g++ found on the machine): float distributions.
# Expected: uniform_real_distribution<float> stays below 1, and a free path drawn from
# exponential_distribution<float> is finite; libstdc++ of GCC 12.2 holds both.
# Seen: a 32-bit number is divided by 2^32 in float, and its 128 largest values round to 1. So the
# uniform number is 1 once in 2^25 and the exponential one, -log(1 - u), is infinite then: with
# std::mt19937 and its default seed 3 times in 200 million. A megapixel frame at 32 samples meets one.
# Do: draw doubles and convert, or reject 1.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
debian_with libc++-14-dev=1:14.0.6-12 libc++1-14=1:14.0.6-12 libc++abi1-14=1:14.0.6-12 libunwind-14=1:14.0.6-12

cat > infinite.cpp <<'CPP'
#include <cmath>
#include <random>
#include "hold.h"
int main() {
#ifdef _LIBCPP_VERSION
    const bool libcxx = true;
#else
    const bool libcxx = false;
#endif
    std::mt19937 u_engine, e_engine;
    std::uniform_real_distribution<float> uniform;
    std::exponential_distribution<float> exponential;
    int ones = 0, infinite = 0;
    for (int i = 0; i < 200'000'000; ++i) {
        ones += uniform(u_engine) >= 1;
        infinite += std::isinf(exponential(e_engine));
    }
    std::printf("%s: 1 came %d times, infinity %d times in 200 million\n",
                libcxx ? "libc++" : "libstdc++", ones, infinite);
    hold(libcxx ? ones == 3 && infinite == 3 : ones == 0 && infinite == 0, "how often 1 and infinity come");
}
CPP
g++ -std=c++17 -O2 infinite.cpp -o with_libstdcxx
g++ -std=c++17 -O2 -w -nostdinc++ -isystem root/usr/lib/llvm-14/include/c++/v1 infinite.cpp -o with_libcxx \
    -nodefaultlibs root/usr/lib/*/libc++.so.1.0 root/usr/lib/*/libc++abi.so.1.0 -lm -lc -lgcc_s -lgcc \
    -Wl,-rpath-link,"$(echo root/usr/lib/*-linux-gnu)"
./with_libstdcxx
LD_LIBRARY_PATH=$(echo root/usr/lib/*-linux-gnu) ./with_libcxx
