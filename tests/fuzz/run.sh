#!/usr/bin/env bash
# ./carlo fuzz, or
# run.sh --build FOLDER [--seconds N] [--runs N] [--keep FOLDER] [--jobs N] [TARGET ...]: feeds random
# mutations of valid inputs to every reader of foreign bytes (target.h), or to these targets.
#
#   --build FOLDER  the build with carlo_fuzz; without coverage it fuzzes blindly (./carlo fuzz has it)
#   --seconds N     for each target (default: 60; 0: until --runs is reached)
#   --runs N        inputs for each target at most
#   --keep FOLDER   keeps findings, and inputs that reached new code, to start from next time
#   --jobs N        targets at a time (default: 1)
#
# A finding is a crash, a sanitizer's report, a leak, more than a second of processor time, or 256 MB more
# than an idle program takes. Exit code 1 then, with the file that shows it.
set -euo pipefail
here=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../..")
all=(archive exr frame hdr messages numbers obj params part ply questions record scene symbols)

build='' seconds=60 runs=-1 keep='' jobs=1 targets=()
while [ $# -gt 0 ]; do
  case $1 in
    --build | --seconds | --runs | --keep | --jobs)
      [ $# -gt 1 ] || { printf 'fuzz: %s needs a value\n' "$1" >&2 && exit 1; }
      declare "${1#--}=$2" && shift ;;
    --help | -h) sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit ;;
    *)
      [[ " ${all[*]} " = *" $1 "* ]] || { printf 'fuzz: there is no target %s; there are: %s\n' "$1" "${all[*]}" >&2 && exit 1; }
      targets+=("$1") ;;
  esac
  shift
done
for number in "$seconds" "$runs" "$jobs"; do
  [[ $number =~ ^-?[0-9]+$ ]] || { printf 'fuzz: %s is no whole number\n' "$number" >&2 && exit 1; }
done
[ -x "$build/bin/carlo_fuzz" ] || { printf 'fuzz: --build: there is no carlo_fuzz in "%s"\n' "$build" >&2 && exit 1; }
build=$(readlink -f "$build")
[ -z "$keep" ] || { mkdir -p "$keep" && keep=$(readlink -f "$keep"); }
[ ${#targets[@]} != 0 ] || targets=("${all[@]}")

base=/tmp
[ ! -w /dev/shm ] || base=/dev/shm
work=$(mktemp -d "$base/carlo_fuzz_XXXXXX")
trap 'rm -rf "$work"' EXIT

"$build/bin/carlo_test_files" "$root"/tests/common/broken_scenes "$root"/tests/common/found_scenes.txt \
  "$root"/tests/common/images.txt "$root"/tests/renderer/found_files.txt "$work/files" >/dev/null

# Good and bad ones of each kind, small.
seeds() {
  local to=$1 scene=$root/common/scenes/cornell_phong.xml
  case $2 in
    scene) cp "$work"/files/*.xml "$root"/common/scenes/*.xml "$to" ;;
    obj | ply) cp "$work"/files/{,parts/}*."$2" "$root"/tests/common/scenes/*."$2" "$to" ;;
    exr)
      "$build/bin/carlo_render" "$scene" --size 2x2 --spp 32 --quiet -o "$work/plain"
      "$build/bin/carlo_render" "$scene" --size 2x2 --target-error .5 --spp 64 --quiet -o "$work/adaptive"
      cp "$work"/plain.exr "$work"/adaptive.exr "$work"/files/{,parts/}*.exr "$here"/corpus/*.exr "$to" ;;
    hdr) cp "$work"/files/{,parts/}*.hdr "$to" ;;
    archive)
      mkdir -p "$work/in/a"
      printf 'int main() {}\n' | tee "$work/in/a/integration.cpp" >"$work/in/pi.cpp"
      (cd "$work/in" && cmake -E tar cf "$to/one.zip" --format=zip . && tar cf "$to/one.tar" . && tar czf "$to/one.tar.gz" .) ;;
    numbers) for number in 1 -2.5e-3 .5 1e38 1e39 5e-324 0x10 nan 2147483648 1,5; do printf '%s' "$number" >"$to/$number"; done ;;
  esac
}

fuzz() {
  local target=$1 folder=$work/$1 corpus=$work/$1/corpus
  mkdir -p "$folder/seeds" "$corpus"
  [ -z "$keep" ] || { corpus=$keep/$target && mkdir -p "$corpus"; }
  seeds "$folder/seeds" "$target"
  # The memory that sanitizers retain counts as well, so they retain little.
  local code=0 TIMEFORMAT="%U %S"
  # Processor time, because wall time depends on other programs.
  { time (cd "${keep:-$work}" &&
    CARLO_FUZZ_TARGET=$target CARLO_FUZZ_FOLDER=$folder ASAN_OPTIONS=quarantine_size_mb=8:malloc_context_size=8 \
      "$build/bin/carlo_fuzz" "$corpus" "$folder/seeds" -max_total_time="$seconds" -runs="$runs" -timeout=60 \
      -rss_limit_mb=640 -malloc_limit_mb=256 -artifact_prefix="finding-$target-" -print_final_stats=1 \
      >"$folder/log" 2>&1) || code=$?; } 2>"$folder/seconds"
  local inputs
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/log")
  local peak
  peak=$(sed -n 's/^stat::peak_rss_mb: *//p' "$folder/log")
  if [ "$code" = 0 ]; then
    printf '%-10s %10s inputs in %6.0f processor s, %4s MB at most, no finding\n' "$target" "$inputs" \
      "$(awk 'END { print $1 + $2 }' "$folder/seconds")" "$peak"
    return 0
  fi
  printf '%-10s FINDING (exit code %s):\n' "$target" "$code"
  grep -E -A12 'ERROR|FINDING|SUMMARY|terminate|what\(\)' "$folder/log" | head -40
  local file
  for file in "${keep:-$work}"/finding-"$target"-*; do
    [ -e "$file" ] || continue
    printf 'the input (%s bytes): %s\n' "$(stat -c %s "$file")" "$(head -c 300 "$file" | base64 -w0)"
  done
  return 1
}

failed=0 running=0
for target in "${targets[@]}"; do
  fuzz "$target" &
  running=$((running + 1))
  if [ "$running" -ge "$jobs" ]; then
    wait -n || failed=1
    running=$((running - 1))
  fi
done
while [ "$running" -gt 0 ]; do
  wait -n || failed=1
  running=$((running - 1))
done
exit $failed
