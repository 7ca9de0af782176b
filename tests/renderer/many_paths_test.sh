#!/usr/bin/env bash
# many_paths_test.sh PROGRAM SOURCE: the program prints a row for every scene, and on Ctrl-C what
# was done so far.
set -euo pipefail
program=$1 scenes=$2/common/scenes
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

"$program" --folder "$scenes" --paths 5000 >"$scratch/table" || fail "exit code $?"
for scene in "$scenes"/*.xml; do
  awk -v name="$(basename "$scene" .xml)" '$1 == name && $2 >= 5000 && $6 == 0 { found = 1 }
    END { exit !found }' "$scratch/table" || fail "no row for $scene: $(cat "$scratch/table")"
done

awk '$1 == "all" && $3 > 0 { found = 1 } END { exit !found }' "$scratch/table" || fail "no light path: $(cat "$scratch/table")"

# On a busy machine two seconds may not be enough for a path.
for seconds in 2 8 32; do
  code=0
  timeout --signal=INT "$seconds" "$program" --folder "$scenes" --paths 1e12 >"$scratch/table" || code=$?
  [ "$code" = 124 ] || fail "Ctrl-C did not end it: exit code $code"
  ! grep -q '^all .*[1-9]' "$scratch/table" || break
done
grep -q '^all .*[1-9]' "$scratch/table" || fail "nothing was printed: $(cat "$scratch/table")"
grep -q '^interrupted' "$scratch/table" || fail "nobody says that it was interrupted"
