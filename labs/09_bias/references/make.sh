#!/usr/bin/env bash
# make.sh: renders this folder's images again, the references of `./carlo lab 9 --step practice`:
# scenes of common/scenes by the reference renderer, with the standard error of each pixel; caustics
# at its own size, the others at half theirs. They come with the lab, since a students' tree has no
# reference renderer. Takes a few minutes of one processor.
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
