#!/usr/bin/env bash
# merge_test.sh RENDERER MERGE SOURCE: shards of a render, merged by `./carlo merge`, have the same
# bits as a render on one machine; shards_in_full.sh tests all of it at length.
set -euo pipefail
renderer=$1 merge=$2 source=$3
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/expect_error.sh"
cd "$scratch"

# Scenes of each kernel and technique, a mesh among them; one thread and two.
for scene in cornell_phong.xml caustics.xml procedural.xml mesh; do
  file=$source/common/scenes/$scene
  [ "$scene" != mesh ] || file=$source/tests/common/scenes/meshes.xml
  "$renderer" "$file" --quiet --size 24x40 --spp 24 --seed 7 -o whole
  for shard in 1 2 3 4 5; do
    "$renderer" "$file" --quiet --size 24x40 --spp 24 --seed 7 --threads $((shard % 2 + 1)) \
      --shard $shard/5 -o part$shard
  done
  "$merge" --quiet part4.part part2.part -o some.part
  "$merge" --quiet part5.part some.part part1.part part3.part -o merged
  for suffix in exr png error.png; do
    cmp whole.$suffix merged.$suffix || complain "$scene: merged.$suffix has other bits"
  done
  strip() { grep -v '"\(seconds\|threads\|parts\|share\)"' "$1"; }
  rm ./*.part
  diff <(strip whole.json) <(strip merged.json) || complain "$scene: another report"
done
grep -q '"parts": 5' merged.json || complain 'the report does not tell the number of parts'

# A merged render can be resumed like any other.
"$renderer" --quiet --resume merged.exr --spp 48
"$renderer" --quiet --resume whole.exr --spp 48
cmp whole.exr merged.exr || complain 'a merged render goes on to other bits'
finish
