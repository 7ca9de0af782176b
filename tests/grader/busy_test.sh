#!/usr/bin/env bash
# busy_test.sh GRADER_TESTS: deadlines on a machine whose processors others keep busy. Each of them in a
# session of its own: Linux shares processors out among sessions first.
set -euo pipefail
others=()
trap 'kill -KILL "${others[@]}" 2>/dev/null || true' EXIT
for ((i = 0; i < 6 * $(nproc); ++i)); do
  setsid bash -c 'while :; do :; done' &
  others+=($!)
done
"$1" '[.busy]'
