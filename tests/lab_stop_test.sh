#!/usr/bin/env bash
# lab_stop_test.sh PROGRAMS SOURCE: Ctrl-C ends a lab's program as a signal does, with one line that says
# so and names the experiment, and leaves nothing of its page.
set -euo pipefail
programs=$1 source=$2
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

# Plots of code that the last verdict found wrong say so, until it is edited.
mkdir -p labs .carlo
cp -r "$source/labs/01_integration" labs/
"$source/tests/grader/mistakes.awk" put labs/01_integration/integration.cpp \
  "$source/tests/01_integration/mistakes/average.txt" average_by_n_plus_one
"$programs/lab01_judge" --lab labs/01_integration/lab.json --worker "$programs/lab01_worker_mistake_average_by_n_plus_one" \
  --book .carlo/verdicts.json --sandbox limits >text 2>&1 || true
run_as_student() {
  CARLO_COURSE=$scratch "$programs/lab01_solution" --n 1024 --quick --no-predict --page page.html >text </dev/null
}
run_as_student
if ! grep -q '^Wrong by ./carlo test 1: 1.1, 1.2\.' text || ! grep -q 'Wrong by ./carlo test 1: 1.1, 1.2\.' page.html; then
  printf 'FAILED: not a word that 1.1 is wrong, and with it 1.2\n' && cat text
  exit 1
fi
sed -i 's|^// Lab 1.1.*|&\n// edited|' labs/01_integration/integration.cpp
run_as_student
! grep -q 'Wrong by' text || { printf 'FAILED: code that was edited is called wrong\n' && exit 1; }
