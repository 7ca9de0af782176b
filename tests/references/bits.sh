#!/usr/bin/env bash
# bits.sh: writes bits.txt: the SHA-256 of each scene's sums, which every machine must reproduce.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$here/../..
build=$root/build/release

# All instruction sets must agree before the file is written.
(cd "$root" && cmake --preset release -DCARLO_EVERY_INSTRUCTION_SET=ON >/dev/null)
ninja -C "$build" --quiet carlo_bits >&2
"$build/bin/carlo_bits" --write "$here/bits.txt"
