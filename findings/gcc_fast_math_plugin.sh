#!/usr/bin/env bash
# GCC 12.2 (the gcc found on the machine, x86-64): linking a shared library with -ffast-math.
# Expected: the option changes the library's own code.
# Seen: loading the library makes the processor flush denormal numbers to zero in the thread that
# loads it. A program compiled without the option changes its results though it never calls the
# library: 1e-40f / 2 is 0. With -ffast-math on the compilation only, it does not.
# Do: don't pass -ffast-math to the link of a shared library; GCC 13 ignores it there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cc=${CC:-gcc}

cat > plugin.c <<'C'
float twice(float x) { return 2 * x; }
C
cat > host.c <<'C'
#include <dlfcn.h>
#include <stdio.h>
int main(int count, char** names) {
    volatile float small = 1e-40f;
    float half = small / 2;
    printf("%d", half > 0);
    if (count > 1 && !dlopen(names[1], RTLD_NOW)) return 1;
    half = small / 2;
    printf("%d\n", half > 0);
}
C
"$cc" -O2 host.c -o host -ldl
"$cc" -O2 -fPIC -ffast-math -c plugin.c
"$cc" -shared plugin.o -o compiled.so
"$cc" -shared -ffast-math plugin.o -o linked.so
[ "$(./host)" = 11 ] || { echo "changed: 1e-40f / 2 is 0 without a library" >&2; exit 1; }
[ "$(./host ./compiled.so)" = 11 ] || { echo "changed: -ffast-math on compiling has the effect" >&2; exit 1; }
[ "$(./host ./linked.so)" = 10 ] || { echo "changed: -ffast-math on linking has no effect" >&2; exit 1; }
echo "1e-40f / 2 is 0 in a program that loaded a library linked with -ffast-math ($("$cc" -dumpfullversion))"
