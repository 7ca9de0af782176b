#!/usr/bin/env bash
# build.sh [TARGET ...]: where the time of a build goes; ./carlo bench build. Builds everything, or the
# targets, from nothing and without the compiler cache in build/profile, and prints processor seconds:
# of each folder (front end, templates, code), of the dearest files, and of linking.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../..")
case ${1:-} in
  --help | -h)
    sed -n '2,/^set/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" | sed '$d'
    exit ;;
esac

build=$root/build/profile log=$root/build/profile/times.txt
rm -rf "$build"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-ftime-report \
  "-DCMAKE_CXX_COMPILER_LAUNCHER=$here/timed.sh;$log" "-DCARLO_OWN_LAUNCHER=$here/timed.sh;$log" \
  "-DCMAKE_CXX_LINKER_LAUNCHER=$here/timed.sh;$log" >/dev/null
begun=$SECONDS
ninja -C "$build" --quiet "${@:-all}" >&2

awk -v wall="$((SECONDS - begun))" '
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
    printf "wall clock: %d s\n\nthe dearest files:\n", wall
  }' "$log"
# Not by a pipe into head: sort would end by a signal.
sort -rn "$log" | sed -n '1,15p' | sed -E 's/CMakeFiles\/([^/]*)\.dir\/(.*together\/)?/\1: /'
