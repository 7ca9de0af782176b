#!/usr/bin/env bash
# student_tree_test.sh SOURCE CMAKE_ARGUMENT...: the students' archives, after labs 1, 4 and 9. They
# contain nothing that they must not; the same commit gives the same bytes; each configures, and by
# default treats no warning as an error; the first and the last build their newest lab's judge and
# worker, and judge the stub as not begun.
set -euo pipefail
source=$1
shift
cmake_arguments=("$@")

command -v git >/dev/null || { printf 'skipped: archives are made from what git holds, and git is not installed\n' && exit 77; }

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# starter K FILE: makes an archive of the current files, committed or not.
starter() {
  "$source/carlo" starter --dirty --through "$1" -o "$2" >/dev/null || fail "starter --through $1"
}

# unpacked K: unpacks the archive's tree into $scratch/K/carlo.
unpacked() {
  starter "$1" "$scratch/$1.tar.gz"
  mkdir "$scratch/$1"
  tar -C "$scratch/$1" -xzf "$scratch/$1.tar.gz"
}

must_not_hold() {
  local tree=$1 pattern
  shift
  for pattern in "$@"; do
    [ -z "$(find "$tree" -path "$tree/$pattern" -print -quit)" ] || fail "$pattern is in the archive"
  done
}

# formulas_are_there TREE: everything of the slides that handouts, hints and sources cite can be
# looked up.
formulas_are_there() {
  local cited
  cited=$(grep -rhoE 'slides [0-9]{2}:[a-z0-9-]+' "$1/labs" --include=README.md --include=lab.json \
    --include=*.h --include=*.cpp | sed 's/^slides //' | sort -u)
  [ "$(wc -l <<<"$cited")" -gt 10 ] || fail "few formulas are cited: $cited"
  while read -r name; do
    grep -qF "**$name**" "$1/labs/formulas.md" || fail "$name is cited and not in labs/formulas.md"
  done <<<"$cited"
}

# expect_error TREE PATTERN CARLO_ARGUMENT...: one line on stderr, exit code 1.
expect_error() {
  local tree=$1 pattern=$2 code=0 text
  shift 2
  text=$("$tree/carlo" "$@" 2>&1 >/dev/null) || code=$?
  [ "$code" = 1 ] && [ "$(wc -l <<<"$text")" = 1 ] && grep -Eq "$pattern" <<<"$text" ||
    fail "a student's ./carlo $*: exit code $code, \"$text\""
}

configured() {
  cmake -G Ninja -S "$1/carlo" -B "$1/carlo/build/release" "${@:2}" >"$scratch/log" 2>&1 ||
    { cat "$scratch/log" && fail "a student's tree does not configure"; }
}

# begun_nowhere FOLDER LAB: builds the newest lab and judges it as delivered.
begun_nowhere() {
  local lab=$2 number=${2%%_*} code=0 report
  ninja -C "$1/carlo/build/release" carlo_verbs "lab${number}_judge" "lab${number}_worker" >"$scratch/log" 2>&1 ||
    { tail -40 "$scratch/log" && fail "a student's tree does not build"; }
  report=$("$1/carlo/build/release/bin/lab${number}_judge" --lab "$1/carlo/labs/$lab/lab.json" \
    --worker "$1/carlo/build/release/bin/lab${number}_worker") || code=$?
  printf '%s\n' "$report"
  [ "$code" = 1 ] || fail "the stub's exit code is $code, expected 1"
  grep -Eq "Lab $number: 0 of [0-9]+ points" <<<"$report" || fail "the stub has points"
  grep -q "start with Lab $((10#$number)).1, ./carlo hint $((10#$number)).1" <<<"$report" ||
    fail "nobody says where to start"
}

# at_once TREE: correct code gets all its points although several ./carlo build and judge it at the
# same time, the text changes between them, and one is killed while it builds.
at_once() {
  local carlo=$1/carlo own=$1/labs/01_integration/integration.cpp round exercise pids code
  cp "$own" "$scratch/stub.cpp"
  for round in 1 2 3; do
    pids=()
    for exercise in 1.1 1.2 1.3 1; do
      { cat "$source/solutions/01_integration/integration.cpp" && printf '// %s, %s\n' "$round" "$exercise"; } >"$own.new"
      mv "$own.new" "$own"
      "$carlo" test "$exercise" >"$scratch/test$exercise" 2>&1 &
      pids+=($!)
    done
    { cat "$own" && printf '// and again\n'; } >"$own.new" && mv "$own.new" "$own"
    setsid "$carlo" test 1.4 >/dev/null 2>&1 &
    sleep ".$round"
    kill -9 $! || true
    for exercise in 1.1 1.2 1.3 1; do
      wait "${pids[0]}" || { cat "$scratch/test$exercise" && fail "test $exercise beside others"; }
      pids=("${pids[@]:1}")
    done
  done
  grep -q 'waiting for ./carlo test 1' "$scratch"/test* || fail "nobody had to wait"
  mv "$scratch/stub.cpp" "$own"
}

# hint_at_once TREE: a hint does not wait for anybody's build.
hint_at_once() {
  local text
  "$1/carlo" hint 1.1 >/dev/null 2>&1 || fail "no hint of 1.1"
  "$1/common/course/in_turn.sh" "$1/build/release" bash -c 'touch "$1"; while [ -e "$1" ]; do sleep .1; done' - "$scratch/builds" &
  until [ -e "$scratch/builds" ]; do sleep .1; done
  text=$(timeout 600 "$1/carlo" hint 1.1 --all 2>&1) || fail "no hint while somebody builds: $text"
  ! grep -q waiting <<<"$text" || fail "a hint waits: $text"
  rm "$scratch/builds"
  wait
}

for last in 1 4 9; do
  unpacked "$last"
  tree=$scratch/$last/carlo
  must_not_hold "$tree" 'solutions/renderer' 'solutions/CMakeLists.txt' 'solutions/*bench*' \
    'tests/*/mistakes' 'tests/*/variants*' tests/renderer tests/references tests/hard_cases tests/common .ci \
    tests/grader/release tests/grader/grade tests/grader/attacks tests/grader/calibrate
  "$source/tests/grader/release/leaks.sh" "$source" "$tree" "$last" || fail "the archive tells answers"
  formulas_are_there "$tree"
  [ "$(find "$tree/labs" -name lab.json | wc -l)" = "$last" ] || fail "labs beyond $last, or too few"
  expect_error "$tree" "there is no ./carlo starter in this folder" starter --through 1
  expect_error "$tree" "there is no ./carlo slides in this folder" slides --check
done
configured "$scratch/1" "${cmake_arguments[@]}"
configured "$scratch/9" "${cmake_arguments[@]}"

# Students' compilers may be newer than ours: their warnings are not errors.
configured "$scratch/4"
commands=$(ninja -C "$scratch/4/carlo/build/release" -t commands)
grep -q -e -Wconversion <<<"$commands" && ! grep -q -e -Werror <<<"$commands" ||
  fail "a student's tree takes warnings for errors"

# A leak must be detected: the last lab's solution in place of its stub.
cp "$source/solutions/09_bias/steps/d_photons.cpp" "$scratch/9/carlo/labs/09_bias/"
if "$source/tests/grader/release/leaks.sh" "$source" "$scratch/9/carlo" 9 >/dev/null; then
  fail "a solution in the archive is not seen"
fi
rm "$scratch/9/carlo/labs/09_bias/d_photons.cpp"

# Whoever makes it, at any time.
(umask 077 && TZ=Asia/Tokyo && starter 4 "$scratch/again.tar.gz")
cmp "$scratch/4.tar.gz" "$scratch/again.tar.gz" || fail "the same tree gives other bytes"

begun_nowhere "$scratch/1" 01_integration
at_once "$scratch/1/carlo"
hint_at_once "$scratch/1/carlo"
begun_nowhere "$scratch/9" 09_bias
for last in 1 9; do
  tree=$scratch/$last/carlo
  expect_error "$tree" "a student's tree" test --hard
  expect_error "$tree" "a student's tree" test --solutions
  expect_error "$tree" "no solution of lab $last" lab "$last" --solutions
done
# Not by a pipe: grep ends at the first line that fits, and ninja at its next write.
commands=$(ninja -C "$scratch/9/carlo/build/release" -t commands lab09_worker)
for earlier in 07_hemisphere/hemisphere.cpp 08_path_tracer/steps/h_path_tracer.cpp; do
  grep -q "solutions/$earlier" <<<"$commands" || fail "lab 9 does not build on the released $earlier"
done

# Lab 8's stub renders nothing, says so, and leaves no files.
ninja -C "$scratch/9/carlo/build/release" lab08_render >"$scratch/log" 2>&1 ||
  { tail -40 "$scratch/log" && fail "lab 8's renderer does not build"; }
CARLO_PRESET=release expect_error "$scratch/9/carlo" 'Lab 8.8 is not implemented yet: run ./carlo hint 8.8' \
  render --size 8x8 --spp 1 -o "$scratch/image"
[ -z "$(find "$scratch" -maxdepth 1 -name 'image*')" ] || fail "the stub's render left files"
