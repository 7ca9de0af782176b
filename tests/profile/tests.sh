#!/usr/bin/env bash
# tests.sh [BUILD]: shows where the time of the last run of ctest in a build folder went (default:
# build/release); ./carlo bench tests. Wall-clock seconds: a busy machine takes more.
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
case ${1:-} in
  --help | -h)
    sed -n '2,/^set/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" | sed '$d'
    exit ;;
esac
log=${1:-$root/build/release}/Testing/Temporary/LastTest.log
[ -f "$log" ] || { printf 'there is no %s: run ./carlo test --solutions first\n' "$log" >&2 && exit 1; }
awk '
  /^[0-9]+\/[0-9]+ Testing: / { sub(/^[^:]*: /, ""); name = $0 }
  /^Test time = / { print $4, name }
' "$log" | sort -rn | awk '
  { kind = $2
    if (kind ~ /\.(mistake|variant)\./) kind = "mistakes and variants"
    else if (kind ~ /^lab[0-9]+\.seeds/) kind = "solutions, several seeds"
    else if (kind ~ /^lab[0-9]/) kind = "labs: all else"
    else sub(/[.:].*/, "", kind)
    seconds[kind] += $1; count[kind]++; all += $1; n++
    if (NR <= 20) dearest = dearest sprintf("%8.1f  %s\n", $1, substr($0, index($0, $2))) }
  END {
    printf "%-28s %6s %8s\n", "wall seconds", "tests", "all"
    for (kind in seconds) printf "%-28s %6d %8.1f\n", kind, count[kind], seconds[kind] | "sort -t: -k1,1"
    close("sort -t: -k1,1")
    printf "%-28s %6d %8.1f\n\nthe longest:\n%s", "all", n, all, dearest
  }'
