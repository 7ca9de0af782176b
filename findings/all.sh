#!/usr/bin/env bash
# all.sh [NAME...]: runs the findings, or those with these names, one after the other, and prints a table:
# each with its seconds and whether it is still as stated. Exit code 0: all are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
names=("$@")
if [ $# = 0 ]; then
  for script in *_*.sh; do names+=("${script%.sh}"); done
fi
for name in "${names[@]}"; do
  [ -f "$name.sh" ] || { printf 'all: there is no finding %s\n' "$name" >&2 && exit 1; }
done
log=$(mktemp)
trap 'rm -f "$log"' EXIT
changed=0
printf '%-32s %7s  %s\n' finding seconds ''
for name in "${names[@]}"; do
  start=$SECONDS
  words='as stated'
  bash "$name.sh" >"$log" 2>&1 || { words="changed: $(tail -n 1 "$log")" && changed=1; }
  printf '%-32s %7d  %s\n' "$name" $((SECONDS - start)) "$words"
done
exit "$changed"
