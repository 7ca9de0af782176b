#!/usr/bin/env bash
# make.sh: makes this folder's images again, which `./carlo lab 9 --step practice` measures against:
# scenes of common/scenes by the reference renderer, with the standard error of each pixel; caustics at
# its own size, the others at half of theirs. A students' tree has no reference renderer, so they come
# with the lab. Some minutes of one processor.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
build=$here/../../../build/release
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

ninja -C "$build" --quiet carlo_references >&2
references() { "$build/bin/carlo_references" --folder "$scratch" --target .003 --most 16384 "$@"; }
references --side 256 caustics
references --side 128 indirect big_light soft_shadows
mv "$scratch"/scenes/*.exr "$here/"
