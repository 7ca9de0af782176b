#!/usr/bin/env bash
# bench_cycles_stand_in_test.sh BENCH SOURCE RENDER: the part cycles of `./carlo bench` with our own
# renderer in Blender's place: an image of the same scene passes, one of another scene fails the run in
# spite of its page, a Blender that fails is told of, and without Blender there is one line.
set -euo pipefail
bench=$1 source=$2 render=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/references"
cp "$source/tests/references/scenes/"{cornell_lambert,furnace}.exr "$scratch/references"

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# Renders what the bench asks for, with these options in addition.
stand_in() {
  cat >"$scratch/$1" <<EOF
#!/usr/bin/env bash
set -e
[ "\$1" != --version ] || exit 0
input=\${*: -1}
seed=\$(grep -o '"seed":[0-9]*' "\$input")
output=\$(grep -o '"output":"[^"]*"' "\$input" | cut -d '"' -f 4)
"$render" "$source/common/scenes/cornell_lambert.xml" --size 128x128 --spp 64 --sampler independent \
  --seed "\${seed#*:}" -o "\${output%.exr}" ${*:2} >"$scratch/render.log"
echo 'carlo: {"seconds": 2.0, "version": "stand-in"}'
EOF
  chmod +x "$scratch/$1"
}

# run CODE BLENDER: its table to $scratch/out; the page is there whatever happened.
run() {
  local code=0
  rm -rf "$scratch/page"
  "$bench" --scenes "$source/common/scenes" --references "$scratch/references" --scratch "$scratch" \
    --only cycles --blender "$scratch/$2" --seed 31 --page "$scratch/page/page.html" \
    >"$scratch/out" 2>"$scratch/stderr" || code=$?
  [ "$code" = "$1" ] || fail "exit code $code, not $1, with $2: $(cat "$scratch/out" "$scratch/stderr")"
  [ -s "$scratch/page/page.html" ] || fail "no page with $2"
}

stand_in same
run 0 same
grep -q 'Cycles of Blender stand-in' "$scratch/out" || fail "no table: $(cat "$scratch/out")"
grep -Eq '"ratio": [0-9.]+,' "$scratch/page/page.json" || fail 'no ratio in the JSON file'
grep -q 'furnace (spheres)' "$scratch/page/page.html" || fail 'the page does not say what is left out'
grep -q '"faults": \[\]' "$scratch/page/page.json" || fail 'a fault in spite of agreement'

stand_in other -D maxDepth=4
run 1 other
grep -q "image of cornell_lambert is not ours" "$scratch/out" || fail "$(cat "$scratch/out")"
grep -q "image of cornell_lambert is not ours" "$scratch/page/page.json" || fail 'no fault as JSON'

printf '#!/bin/sh\n[ "$1" = --version ] || { echo "Error: no memory"; exit 3; }\n' >"$scratch/broken"
chmod +x "$scratch/broken"
run 1 broken
grep -q 'Blender failed (exit code 3): Error: no memory' "$scratch/out" || fail "$(cat "$scratch/out")"

run 0 missing
grep -q 'apt-get install --no-install-recommends blender' "$scratch/out" || fail "$(cat "$scratch/out")"
