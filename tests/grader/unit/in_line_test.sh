#!/usr/bin/env bash
# in_line_test.sh GRADER_TESTS: a worker waits for a processor longer than its deadline, while its
# judge has priority: the wait is not charged, although the system reports it only when it is over.
# As root.
set -euo pipefail
for tool in chrt taskset; do
  command -v "$tool" >/dev/null || { echo "skipped: needs $tool" && exit 77; }
done
chrt -f 1 true 2>/dev/null || { echo "skipped: may not favour a program (root may)" && exit 77; }
last=$(($(nproc) - 1))
taskset -c "$last" chrt -f 1 bash -c 'while :; do
  for ((end = ${EPOCHREALTIME/[.,]/} + 2500000; ${EPOCHREALTIME/[.,]/} < end; )); do :; done
  sleep 0.4
done' &
other=$!
trap 'kill -KILL "$other" 2>/dev/null || true' EXIT
code=0
taskset -c "$last" chrt -R -f 5 "$1" '[.busy]' || code=$?
[ "$code" != 4 ] || exit 77 # Catch2's code if all tests were skipped
exit "$code"
