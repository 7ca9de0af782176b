#!/usr/bin/env bash
# busy_test.sh GRADER_TESTS [bomb]: deadlines on a machine whose processors others keep busy. Each of them in
# a session of its own: Linux shares processors out among sessions first. `bomb`: a fork bomb is proven to
# be one all the same, by the processor time that all its processes take together. For two processors; of
# more, others leave it too little of each.
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
[ "$code" != 4 ] || exit 77 # Catch2's for tests that were all skipped
exit "$code"
