#!/usr/bin/env bash
# make.sh [SCENE ...]: makes this folder's images again, which `./carlo lab 9 --step practice` is
# measured against: small ones of scenes in common/scenes, by the reference renderer, with the standard
# error of each pixel. A students' tree has no reference renderer, so they come with the lab.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$here/../../..
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

[ $# -gt 0 ] || set -- caustics indirect big_light soft_shadows
for scene in "$@"; do
  "$root/carlo" render "$root/common/scenes/$scene.xml" --size 64x64 --sampler independent --seed 101 \
    --spp 65536 --no-sums -o "$scratch/$scene"
  mv "$scratch/$scene.exr" "$here/"
done
