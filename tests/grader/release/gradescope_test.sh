#!/usr/bin/env bash
# gradescope_test.sh SOURCE: run_autograder with a fake grader: results come through complete, and
# any failure gives JSON with a message and without score and tests. The zip's tree can be built.
set -euo pipefail
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
export AUTOGRADER=$scratch/autograder CARLO_GRADING_SECONDS=2 TMPDIR=$scratch/tmp
mkdir "$TMPDIR"
results=$AUTOGRADER/results/results.json

complain() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

# json FIELD: prints its value in the results, or NOTFOUND; fails if they are not JSON.
json() {
  printf 'file(READ "%s" t)\nstring(JSON v ERROR_VARIABLE e GET "${t}" %s)\n' "$results" "$1" \
    >"$scratch/json.cmake"
  printf 'string(JSON kind TYPE "${t}")\nmessage("${v}")\n' >>"$scratch/json.cmake"
  cmake -P "$scratch/json.cmake" 2>&1
}

# graded SCRIPT: sets up an autograder whose grader is SCRIPT, and runs it.
graded() {
  rm -rf "$AUTOGRADER"
  mkdir -p "$AUTOGRADER/source/carlo" "$AUTOGRADER/submission"
  printf '1\n' >"$AUTOGRADER/source/lab"
  printf 'secret\n' >"$AUTOGRADER/source/secret"
  printf 'int main() {}\n' >"$AUTOGRADER/submission/it's \"quoted\" \\ .cpp"
  printf '#!/usr/bin/env bash\n%s\n' "$1" >"$AUTOGRADER/source/carlo/carlo"
  chmod +x "$AUTOGRADER/source/carlo/carlo"
  "$source/tests/grader/release/gradescope/run_autograder" >"$scratch/stdout" 2>&1
}

# The results' folder: the grader's last argument.
out='mkdir -p "${@: -1}/submission"; results=${@: -1}/submission/results.json'

graded "$out; "'printf "{\"score\": 3, \"tests\": []}" >"$results"; echo "$@"' ||
  complain "good results are refused"
[ "$(json score)" = 3 ] || complain "the score is $(json score)"
grep -q -- 'grade --one .*/submission --labs 1 --secret-file' "$scratch/stdout" ||
  complain "the grader was called otherwise"
[ "$(stat -c %a "$AUTOGRADER/results")" = 700 ] || complain "others may write results"

# expect_failure PATTERN SCRIPT: there is no score, and staff can read why.
expect_failure() {
  if graded "$2"; then complain "passes for graded: $2"; fi
  [[ $(json score) == *NOTFOUND* && $(json tests) == *NOTFOUND* ]] || complain "a score for: $2"
  [[ $(json output) == 'The autograder failed'* ]] || complain "no message for: $2"
  grep -Eq "THE AUTOGRADER FAILED: $1" "$scratch/stdout" || complain "staff reads nothing for: $2"
}
expect_failure 'the grader could not give all marks' 'echo broken; exit 1'
expect_failure 'the grader could not give all marks' \
  "$out; printf '{\"score\": 0, \"tests\": []}' >\"\$results\"; exit 1"
expect_failure 'there are no results' 'echo well'
expect_failure 'there are no results' "$out; : >\"\$results\""
expect_failure 'there are no results' "$out; printf '{\"score\": 1}' >\"\$results\""
expect_failure 'grading took more than 2 seconds' 'sleep 30'
expect_failure 'grading took more than 2 seconds, or was killed' 'kill -9 $$'
[ -z "$(ls "$TMPDIR")" ] || complain "submissions stay in the folder of temporary files"

# The zip's tree, as its set-up has it built: first of all the verbs, grade among them.
"$source/tests/grader/release/gradescope.sh" 1 --dirty -o "$scratch/lab1.zip" >"$scratch/stdout" || complain "no zip"
mkdir "$scratch/zip"
(cd "$scratch/zip" && cmake -E tar xf "$scratch/lab1.zip")
{ cmake -S "$scratch/zip/carlo" -B "$scratch/build" && cmake --build "$scratch/build" --target carlo_verbs; } \
  >"$scratch/stdout" 2>&1 || complain "the verbs cannot be built: $(tail -n 20 "$scratch/stdout")"
targets=$(cmake --build "$scratch/build" --target help)
for target in carlo_grade lab01_judge; do
  [[ $targets == *$target* ]] || complain "the zip's tree has no $target"
done

printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
