#!/usr/bin/env bash
# shards_in_full.sh BIN SOURCE [bits|cost|thousand ...]: thorough tests of shards (nightly; minutes).
#
#   bits      three scenes in 1, 2, 7 and 64 shards, on one thread and on two, a third of them killed and
#             resumed; merged in 20 random orders and groupings each: one SHA-256 of the sums
#   cost      eight shards, two at once, against one process: processor time, at most 1.1 times. Each
#             has to start (a fifth of a second, mostly libraries) and run the pilot (1/256 of the total)
#   thousand  1000 parts of 512 x 512: at most 60 s of one core and three images of memory
set -euo pipefail
bin=$(readlink -f "$1") source=$(readlink -f "$2")
shift 2
[ $# != 0 ] || set -- bits cost thousand
[ -x /usr/bin/time ] || { printf 'shards_in_full: it takes /usr/bin/time (apt-get install time)\n' >&2 && exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
failures=0
RANDOM=1

complain() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

scene_file() {
  if [ "$1" = mesh ]; then printf '%s' "$source/tests/common/scenes/meshes.xml"; else
    printf '%s' "$source/common/scenes/$1.xml"
  fi
}

# Only the sums, from a single part: its header contains seconds and threads.
sums_of() {
  local skip
  skip=$((13 + 16 + $(od -An -tu8 -j13 -N8 "$1")))
  tail -c +$((skip + 1)) "$1" | sha256sum | cut -d' ' -f1
}

# shard_killed ARGUMENTS...: a shard that is killed in the middle, then its command again.
shard_killed() {
  "$bin/carlo_render" --checkpoint 0 "$@" &
  local pid=$!
  sleep ".2$((RANDOM % 10))"
  kill -"$([ $((RANDOM % 2)) = 0 ] && printf KILL || printf INT)" $pid 2>/dev/null || true
  wait $pid 2>/dev/null || true
  "$bin/carlo_render" "$@"
}

# merge_at_random PARTS...: merges in a random order and grouping, to all.part.
merge_at_random() {
  local parts=("$@") round=0 taken
  rm -f all.part
  while :; do
    mapfile -t parts < <(printf '%s\n' "${parts[@]}" | shuf --random-source=<(yes "$RANDOM$RANDOM"))
    taken=$((1 + RANDOM % ${#parts[@]}))
    if [ "$taken" = ${#parts[@]} ] || [ $round = 3 ]; then
      "$bin/carlo_merge" --quiet "${parts[@]}" -o all.part
      rm -f merged*.part
      return
    fi
    round=$((round + 1))
    "$bin/carlo_merge" --quiet "${parts[@]:0:taken}" -o "merged$round.part"
    parts=("${parts[@]:taken}" "merged$round.part")
  done
}

bits() {
  local scene threads count i render
  for scene in cornell_phong caustics mesh; do
    render=("$(scene_file "$scene")" --quiet --size 64x48 --spp 512 --seed 3)
    "$bin/carlo_render" "${render[@]}" -o whole
    "$bin/carlo_render" "${render[@]}" --shard 1/1 -o whole
    : >found
    for threads in 1 2; do
      for count in 1 2 7 64; do
        for ((i = 1; i <= count; ++i)); do
          if [ $((RANDOM % 3)) = 0 ]; then
            shard_killed "${render[@]}" --threads $threads --shard $i/$count -o "p$i"
          else
            "$bin/carlo_render" "${render[@]}" --threads $threads --shard $i/$count -o "p$i"
          fi
        done
        for ((i = 0; i < 20; ++i)); do
          merge_at_random p*.part
          sums_of all.part >>found
        done
        "$bin/carlo_merge" --quiet p*.part -o image
        cmp image.exr whole.exr || complain "$scene, $count shards: the EXR is another"
        rm p*.part
      done
    done
    sums_of whole.part >>found
    printf '%-14s %s merges: %s\n' "$scene" "$(wc -l <found)" "$(sort -u found | tr '\n' ' ')"
    [ "$(sort -u found | wc -l)" = 1 ] || complain "$scene: sums differ"
    rm ./*.part
  done
}

# processor_seconds COMMAND...: of the command and its children.
processor_seconds() {
  local TIMEFORMAT='%U %S'
  { time "$@" >/dev/null 2>stderr; } 2>&1 | awk '{print $1 + $2}'
}

eight_shards() { seq 8 | xargs -P 2 -I{} "$bin/carlo_render" "$@" --threads 1 --shard {}/8 -o eighth{}; }

cost() {
  local scene spp one eight render
  for scene in cornell_phong caustics; do
    spp=1024
    render=("$(scene_file "$scene")" --quiet --size 512x512 --spp "$spp")
    one=$(processor_seconds "$bin/carlo_render" "${render[@]}" --threads 2 -o one)
    eight=$(processor_seconds eight_shards "${render[@]}")
    "$bin/carlo_merge" --quiet eighth*.part -o merged
    cmp one.exr merged.exr || complain "$scene: other bits"
    awk -v one="$one" -v eight="$eight" -v scene="$scene" 'BEGIN {
      printf "%-14s one process: %.1f s, eight shards: %.1f s, %.3f times\n", scene, one, eight, eight / one
      exit !(eight <= 1.1 * one)}' || complain "$scene: shards are dear"
    rm -f ./*.part
  done
}

# Peak resident memory, in KB.
most_memory() { /usr/bin/time -f %M -o memory "$@" && cat memory; }

# Each part has one sample of every pixel.
thousand() {
  local render seconds base memory image=$((512 * 512 * 208 / 1024))
  render=("$(scene_file cornell_phong)" --quiet --size 512x512 --spp 1001)
  [ "$(df --output=avail -k . | tail -1)" -gt 16000000 ] || { printf 'thousand: skipped, for want of 16 GB\n' && return; }
  seq 1000 | xargs -P 2 -I{} "$bin/carlo_render" "${render[@]}" --threads 1 --shard {}/1000 -o part{}
  "$bin/carlo_render" "$(scene_file cornell_phong)" --quiet --size 1x1 --spp 8 --shard 1/1 -o tiny
  base=$(most_memory "$bin/carlo_merge" --quiet tiny.part -o tiny)
  seconds=$(processor_seconds taskset -c 0 /usr/bin/time -f %M -o memory "$bin/carlo_merge" --quiet part*.part -o merged)
  memory=$(($(cat memory) - base))
  printf '1000 parts of %s: %s s, %s MB beside the %s MB of a merge of one pixel: %s images of %s MB\n' \
    "$(du -h part1.part | cut -f1)" "$seconds" $((memory / 1024)) $((base / 1024)) \
    "$(awk -v m=$memory -v i=$image 'BEGIN {printf "%.2f", m / i}')" $((image / 1024))
  awk -v s="$seconds" 'BEGIN {exit !(s <= 60)}' || complain 'merging 1000 parts takes too long'
  [ $memory -le $((3 * image)) ] || complain 'merging 1000 parts takes too much memory'
  "$bin/carlo_render" "${render[@]}" -o whole
  cmp whole.exr merged.exr || complain '1000 parts: other bits'
}

for step in "$@"; do "$step"; done
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
