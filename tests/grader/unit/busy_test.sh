#!/usr/bin/env bash
# busy_test.sh GRADER_TESTS [bomb]: deadlines on a machine whose processors others keep busy, each
# of them in its own session: Linux divides processors among sessions first. `bomb`: a fork bomb is
# still recognised, by the processor time that all its processes take together. On two processors;
# with more, others leave it too little of each.
set -euo pipefail
others=()
trap 'kill -KILL "${others[@]}" 2>/dev/null || true' EXIT
crowd=$((6 * $(nproc)))
tests='[.busy]'
if [ "${2:-}" = bomb ]; then
  [ "$(nproc)" = 2 ] || { echo "skipped: for two processors" && exit 77; }
  crowd=5
  tests='a fork bomb ends with its worker'
fi
for ((i = 0; i < crowd; ++i)); do
  setsid bash -c 'while :; do :; done' &
  others+=($!)
done
code=0
"$1" "$tests" || code=$?
[ "$code" != 4 ] || exit 77 # Catch2's code if all tests were skipped
exit "$code"
