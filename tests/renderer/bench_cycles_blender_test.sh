#!/usr/bin/env bash
# bench_cycles_blender_test.sh BENCH SOURCE: Cycles' image of the Cornell box is ours, where Blender is
# installed.
set -euo pipefail
command -v blender >/dev/null || { echo "blender is missing" && exit 77; }
bench=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/references"
cp "$source/tests/references/scenes/cornell_lambert.exr" "$scratch/references"
"$bench" --scenes "$source/common/scenes" --references "$scratch/references" --scratch "$scratch" \
  --peer-scripts "$source/solutions/renderer/bench/peers" --only cycles \
  --page "$scratch/page.html"
# At equal error Cycles takes longer; how much is the benchmark's to say.
grep -Eq '"ratio": ([2-9]|[1-9][0-9]+)\.?[0-9]*,' "$scratch/page.json"
