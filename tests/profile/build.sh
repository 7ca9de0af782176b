#!/usr/bin/env bash
# build.sh [--at-most N] [TARGET ...]: shows where the time of a build goes; ./carlo bench build.
# Builds everything, or the targets, from scratch and without the compiler cache in build/profile,
# and prints processor seconds: of each folder (front end, templates, code), of the most expensive
# files, and of linking.
#
# The sum is also given in yardsticks: the time of yardstick.cpp on this machine, before and after.
# With --at-most the exit code is 1 if there are more. The machine should be otherwise idle.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../..")
case ${1:-} in
  --help | -h)
    sed -n '2,/^set/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" | sed '$d'
    exit ;;
esac
at_most=''
if [ "${1:-}" = --at-most ]; then
  at_most=${2:-}
  [[ $at_most =~ ^[0-9]+([.][0-9]+)?$ ]] || { printf 'build.sh: --at-most takes a number of yardsticks (got "%s")\n' "$at_most" >&2 && exit 2; }
  shift 2
fi

build=$root/build/profile log=$root/build/profile/times.txt
rm -rf "$build"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-ftime-report \
  "-DCMAKE_CXX_COMPILER_LAUNCHER=$here/timed.sh;$log" "-DCARLO_OWN_LAUNCHER=$here/timed.sh;$log" \
  "-DCMAKE_CXX_LINKER_LAUNCHER=$here/timed.sh;$log" >/dev/null

# Measured with one per processor at once: neighbours slow each other.
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
measure_yardstick() {
  local i
  for ((i = 0; i < $(nproc); ++i)); do
    "$here/timed.sh" "$build/yardstick.txt" "$compiler" -std=c++20 -O2 -ftime-report -c "$here/yardstick.cpp" -o "$build/yardstick$i.o" &
  done
  wait
}

measure_yardstick
begun=$SECONDS
ninja -C "$build" --quiet "${@:-all}" >&2
wall=$((SECONDS - begun))
measure_yardstick
yardstick=$(awk '{ sum += $1 } END { print sum / NR }' "$build/yardstick.txt")

awk -v wall="$wall" -v yardstick="$yardstick" '
  function folder(path) {
    if (path !~ /\.(o|gch)$/) return "linking"
    if (path ~ /worker_(mistake|variant)/) return "mistakes and variants"
    if (path ~ /_experiments\.dir/) return "labs: experiments"
    if (path ~ /_judge\.dir|_probes\.dir/ && path ~ /^labs/) return "labs: checks and probes"
    sub(/\/?CMakeFiles.*/, "", path)
    return path
  }
  function line(name, n) {
    return sprintf("%-28s %5d %8.1f %8.1f %8.1f %8.1f\n", name, n, all[name], parsing[name], templates[name], code[name])
  }
  {
    f = folder($5)
    count[f]++; count["all"]++
    all[f] += $1; all["all"] += $1
    parsing[f] += $2; parsing["all"] += $2
    templates[f] += $3; templates["all"] += $3
    code[f] += $4; code["all"] += $4
  }
  END {
    printf "processor seconds              files      all    front templates     code\n"
    for (f in count) if (f != "all") printf "%s", line(f, count[f]) | "sort -k1,1"
    close("sort -k1,1")
    printf "%s", line("all", count["all"])
    printf "wall clock: %d s\n", wall
    printf "yardsticks: %.1f, of %.1f s each\n\nthe dearest files:\n", all["all"] / yardstick, yardstick
  }' "$log"
# Not by a pipe into head, which would end sort by a signal.
sort -rn "$log" | sed -n '1,15p' | sed -E 's/CMakeFiles\/([^/]*)\.dir\/(.*together\/)?/\1: /'

[ -z "$at_most" ] || awk -v yardstick="$yardstick" -v at_most="$at_most" '
  { sum += $1 }
  END {
    if (sum / yardstick <= at_most) exit
    printf "build.sh: %.1f yardsticks, %s are allowed\n", sum / yardstick, at_most
    exit 1
  }' "$log" >&2
