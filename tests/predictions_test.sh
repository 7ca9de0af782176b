#!/usr/bin/env bash
# predictions_test.sh SOURCE PROGRAMS: every question in a lab.json finds its answer in a quick run
# of that lab on the solutions: tables, rows and columns have the names in the question. And without
# a terminal nobody is asked.
set -euo pipefail
source=$1 programs=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

ln -s "$source/labs" "$scratch/labs"
mkdir "$scratch/.carlo"
export CARLO_COURSE=$scratch

cat >"$scratch/count.cmake" <<'END'
file(READ "${FILE}" text)
string(JSON rows ERROR_VARIABLE none LENGTH "${text}" tables predictions)
message("${rows}")
END

# A valid answer to every question.
answers() {
  awk '/"tag"/ { split($0, part, "\""); number = substr(part[4], 5) }
       /"kind": "(number|share)"/ { printf "%s\"%s\": 1", sep, number; sep = ", " }
       /"kind": "choice"/ { printf "%s\"%s\": \"x\"", sep, number; sep = ", " }' "$1"
}

for lab in "$source"/labs/*/lab.json; do
  number=$(basename "$(dirname "$lab")")
  number=${number%%_*}
  asked=$(grep -c '"predict"' "$lab") || true
  [ "$asked" -ge 1 ] || { printf 'FAILED: lab %s asks nothing\n' "$number" && failures=$((failures + 1)); }
  printf '{%s}\n' "$(answers "$lab")" >"$scratch/.carlo/predictions.json"
  if ! "$programs/lab${number}_solution" --quick --no-page --json "$scratch/run.json" \
    >"$scratch/text" </dev/null 2>&1; then
    cat "$scratch/text"
    printf 'FAILED: lab %s does not run\n' "$number"
    failures=$((failures + 1))
    continue
  fi
  answered=$(cmake -DFILE="$scratch/run.json" -P "$scratch/count.cmake" 2>&1) || true
  printf 'lab %s: %s questions, %s answered\n' "$number" "$asked" "$answered"
  [ "$asked" = "$answered" ] || failures=$((failures + 1))
  ! grep -q 'Predict first' "$scratch/text" || failures=$((failures + 1))
done
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
