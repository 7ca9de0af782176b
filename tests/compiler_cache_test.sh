#!/usr/bin/env bash
# compiler_cache_test.sh COMPILER [LAUNCHER...]: a header in which only a comment changed compiles
# with a cache that holds its former version. If the cache returned the precompiled header of that
# version, g++ would read each file again, `#pragma once` or not: "redefinition of".
set -euo pipefail
compiler=$1
shift
[ $# != 0 ] || { echo "there is no compiler cache" && exit 77; }
compile_header=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../common/course/cmake/compile_header.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CCACHE_DIR=$work/cache
cd "$work"

compile() {
  rm -f first.h.gch
  "$compile_header" ccache "$@" "$compiler" -std=c++20 -fpch-preprocess -Winvalid-pch -x c++-header -include first.h -MD -MF first.d -o first.h.gch -c empty.cpp
  "$@" "$compiler" -std=c++20 -fpch-preprocess -Winvalid-pch -include first.h -MD -MF unit.d -o unit.o -c unit.cpp
}

printf '#pragma GCC system_header\n#include <included.h>\n' >first.h
: >empty.cpp
for word in first other; do
  printf '#pragma once\n// The %s comment.\nstruct Pair {\n  int first, other;\n};\n' "$word" >included.h
  printf '#include "included.h"\nint of(const Pair& pair) { return pair.%s; }\n' "$word" >unit.cpp
  CPATH=$work compile "$@"
done
# The cache does return its entries.
CPATH=$work compile "$@"
hits=$(ccache --print-stats | awk '$1 == "direct_cache_hit" {print $2}')
[ "${hits:-0}" -ge 2 ] || { echo "the cache found $hits of the last files, not all" && exit 1; }
# An interrupted compilation leaves no checksum, least of all the previous one.
: >gone.gch.sum
if "$compile_header" ccache false -o gone.gch || [ -e gone.gch.sum ]; then
  echo "a header that does not compile has a checksum" && exit 1
fi
