#!/usr/bin/env bash
# Highway 1.0.3 (Debian libhwy-dev), contrib/math: Log, Exp outside ordinary arguments.
# Expected: as std::log and std::exp: -infinity, NaN, infinity, or at least NaN kept.
# Seen: ordinary-looking numbers. Log(0) = -105.36, Log(-1) = 177.4, Log(infinity) = 88.7,
# Log(NaN) = 89.1, Exp(NaN) = 0. A NaN thus vanishes inside, and a test for infinity finds none.
# Exp(infinity) and Exp(-infinity) are right.
# Do: handle 0, negatives, infinity and NaN with IfThenElse around the call.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
debian_with libhwy-dev=1.0.3-3+deb12u1 libhwy1=1.0.3-3+deb12u1

cat > math.cpp <<'CPP'
#include <cmath>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
#include "hold.h"
namespace hn = hwy::HWY_NAMESPACE;
const hn::CappedTag<float, 1> d;
float show(const char* name, float x, float y) {
    std::printf("%s(%g) = %g\n", name, x, y);
    return y;
}
float log_of(float x) { return show("Log", x, hn::GetLane(hn::Log(d, hn::Set(d, x)))); }
float exp_of(float x) { return show("Exp", x, hn::GetLane(hn::Exp(d, hn::Set(d, x)))); }
bool near(float a, float b) { return std::abs(a - b) < 0.1f; }
int main() {
    hold(near(log_of(2.0f), 0.693f), "Log(2)");
    hold(near(log_of(0.0f), -105.36f), "Log(0) is no longer -105.36");
    hold(near(log_of(-1.0f), 177.4f), "Log(-1) is no longer 177.4");
    hold(near(log_of(INFINITY), 88.7f), "Log(infinity) is no longer 88.7");
    hold(near(log_of(NAN), 89.1f), "Log(NaN) is no longer 89.1");
    hold(exp_of(NAN) == 0.0f, "Exp(NaN) is no longer 0");
    hold(exp_of(INFINITY) == INFINITY && exp_of(-INFINITY) == 0.0f, "Exp(infinity)");
}
CPP
g++ -std=c++17 -O1 -Iroot/usr/include math.cpp -o math root/usr/lib/*/libhwy.so.1
LD_LIBRARY_PATH=$(echo root/usr/lib/*-linux-gnu) ./math
