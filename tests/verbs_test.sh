#!/usr/bin/env bash
# verbs_test.sh SOURCE PRESET: verbs of ./carlo with the programs that they hand over to, in a build that is
# up to date: a verb gives its program no option that it does not have. What verbs do with words is
# carlo_script_test.sh's. Without --shard and --slurm, which may configure the build anew, under other tests.
set -euo pipefail
source=$1
export CARLO_PRESET=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
failures=0

# runs CODE VERB...: ends with that exit code and does not complain about an option.
runs() {
  local wanted=$1 code=0
  shift
  "$source/carlo" "$@" >said 2>&1 </dev/null || code=$?
  if [ "$code" != "$wanted" ] || grep -q 'no option' said; then
    printf 'FAILED: ./carlo %s: exit code %s, expected %s: %s\n' "$*" "$code" "$wanted" "$(tail -n 5 said)"
    failures=$((failures + 1))
  fi
}

runs 0 render --size 8x8 --spp 1 -o image
runs 0 render --mine --help
runs 0 merge --help
runs 0 bench --only equal-time --page page.html
runs 0 bench render --help
runs 0 grade --help
runs 0 grade --calibrate --labs 1 --report-only --store none
runs 0 lab 1 --solutions --quick --no-page
runs 0 lab 1 --help
runs 1 test 1.1
runs 0 status
runs 0 slides --check
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
