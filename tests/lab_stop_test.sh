#!/usr/bin/env bash
# lab_stop_test.sh PROGRAMS: Ctrl-C ends a lab's program as a signal does, with one line that says
# so and names the experiment, and leaves nothing of its page.
set -euo pipefail
programs=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# So many points take minutes.
code=0
timeout --preserve-status --signal=INT 2 "$programs/lab01_solution" --n 268435456 --json run.json \
  >text 2>errors || code=$?
if [ "$code" != 130 ] || [ "$(grep -c '^Stopped in the experiment ".*"\.$' errors)" != 1 ]; then
  printf 'FAILED: exit code %s\n' "$code"
  cat errors
  exit 1
fi
[ "$(ls)" = "$(printf 'errors\ntext')" ] || { ls && exit 1; }

# A student's own code may be in a loop: the message says how to find the exercise.
code=0
CARLO_COURSE=$scratch timeout --preserve-status --signal=INT 2 "$programs/lab01_solution" --n 268435456 \
  --no-predict >text 2>errors || code=$?
if [ "$code" != 130 ] || ! grep -qxF 'If it did not end by itself: ./carlo test 1 names the exercise with the endless loop.' errors; then
  printf 'FAILED: no advice, exit code %s\n' "$code"
  cat errors
  exit 1
fi
