#!/usr/bin/env bash
# replay_test.sh CARLO_REPLAY FIXTURE_WORKER SOURCE: questions repeated to the fixture worker:
# values, exceptions and crashes come out as they should.
set -euo pipefail
replay=$1 worker=$2 lab=$3/labs/01_integration/lab.json
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

question() {
  printf '{"tag": "Lab 1.2", "test": "it works", "probe": "%s", "question": "", "rows": 1,' "$1"
  printf ' "params": "seed=12884901888 n=%s",' "${2:-0}"
  printf ' "columns": 1, "status": "passed", "problem": ""}'
}
{
  printf '{"seed": "5", "probes": [%s, %s, %s, %s, %s]}' "$(question 'echo seed')" \
    "$(question throws)" "$(question crash)" "$(question 'not implemented')" "$(question 'exit 3')"
} >"$scratch/questions.json"

# expect CODE PATTERN ARGUMENT...: both output streams together contain the pattern.
expect() {
  local code=0 want=$1 pattern=$2 text
  shift 2
  text=$("$replay" 1.2 --lab "$lab" --questions "$scratch/questions.json" --worker "$worker" "$@" 2>&1) ||
    code=$?
  if [ "$code" != "$want" ] || ! grep -Eq -- "$pattern" <<<"$text"; then
    printf 'FAILED: replay 1.2 %s: exit code %s\n%s\n' "$*" "$code" "$text"
    failures=$((failures + 1))
  fi
}

expect 0 'Lab 1.2 .*seed 5'
expect 0 '^arguments: seed = 12884901888$' --probe 1
expect 0 '^1 value came back:$' --probe 1
expect 0 '^ +high word of the seed +3$' --probe 'echo seed'
expect 1 'no values: ' --probe throws
expect 1 'Lab 1.2 crashed.*--seed 5 --probe 3|Lab 1.2 crashed in' --probe crash
expect 1 'no values: .*not implemented' --probe 4
expect 1 'crashed: exit code 3' --probe 'exit 3'
expect 1 'only 1 to 5' --probe 6
expect 1 'cannot be run.*apt-get install gdb' --probe 1 --debugger no-such-debugger
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
