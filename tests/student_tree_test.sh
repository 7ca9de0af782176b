#!/usr/bin/env bash
# student_tree_test.sh SOURCE CMAKE_ARGUMENT...: the tree as students get it (without the solutions,
# without what is tested with them) configures, builds lab 01's judge and worker, judges the stub as
# one that has been begun nowhere, and renders by lab 08, which says that it has not been begun either.
set -euo pipefail
source=$1
shift

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tree=$scratch/tree
mkdir "$tree"
tar -C "$source" -c --exclude=./build --exclude=./out --exclude=./.git --exclude=./.carlo \
  --exclude=./solutions --exclude='./tests/*/mistakes' --exclude=./tests/renderer \
  --exclude=./tests/references --exclude=./slides . | tar -C "$tree" -x

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

export CCACHE_BASEDIR=$scratch
build=$tree/build/release
cmake -G Ninja -S "$tree" -B "$build" "$@" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log" && fail "a student's tree does not configure"; }
ninja -C "$build" lab01_judge lab01_worker lab08_render >"$scratch/log" 2>&1 ||
  { tail -40 "$scratch/log" && fail "a student's tree does not build"; }

code=0
report=$("$build/bin/lab01_judge" --lab "$tree/labs/01_integration/lab.json" \
  --worker "$build/bin/lab01_worker") || code=$?
printf '%s\n' "$report"
[ "$code" = 1 ] || fail "the stub's exit code is $code, expected 1"
grep -q 'Lab 01: 0 of 20 points' <<<"$report" || fail "the stub has points"
grep -q 'start with Lab 1.1, ./carlo hint 1.1' <<<"$report" || fail "nobody says where to start"

code=0
message=$(CARLO_PRESET=release "$tree/carlo" render --size 8x8 --spp 1 -o "$scratch/image" 2>&1) || code=$?
printf '%s\n' "$message"
[ "$code" = 1 ] || fail "rendering by the stub gives exit code $code, expected 1"
grep -q 'Lab 8.8 is not implemented yet: run ./carlo hint 8.8' <<<"$message" ||
  fail "nobody says which exercise the image waits for"
[ "$(wc -l <<<"$message")" = 1 ] || fail "more than one line"
[ -z "$(find "$scratch" -maxdepth 1 -name 'image*')" ] || fail "the stub's render left files"
