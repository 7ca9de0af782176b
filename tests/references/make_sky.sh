#!/usr/bin/env bash
# make_sky.sh: writes the sky of common/scenes/image_light.xml, common/scenes/parts/sky.exr.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
build=$root/build/release

[ -f "$build/build.ninja" ] || (cd "$root" && cmake --preset release >/dev/null)
ninja -C "$build" --quiet carlo_sky >&2
"$build/bin/carlo_sky" "$root/common/scenes/parts/sky.exr"
