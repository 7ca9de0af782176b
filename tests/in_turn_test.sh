#!/usr/bin/env bash
# in_turn_test.sh SOURCE: builds take turns (common/course/in_turn.sh), even when one is killed.
set -euo pipefail
in_turn=$1/common/course/in_turn.sh
command -v flock >/dev/null || { echo "there is no flock: nobody waits" && exit 77; }
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# until_there FILE
until_there() {
  for _ in {1..6000}; do [ ! -e "$1" ] || return 0; sleep .05; done
  fail "$1 did not come"
}

code=0
"$in_turn" "$build" bash -c 'exit 7' || code=$?
[ "$code" = 7 ] || fail "exit code $code, expected the command's"

# One at a time, and the second learns the first one's name.
CARLO_TURN_OF='the first' "$in_turn" "$build" bash -c 'touch "$1/first" && sleep 1 && rm "$1/first"' - "$build" &
until_there "$build/first"
"$in_turn" "$build" bash -c '[ ! -e "$1/first" ] && touch "$1/second"' - "$build" 3>"$build/told" || fail "two at once"
grep -q '^carlo: waiting for the first, which builds' "$build/told" || fail "the second was told: $(cat "$build/told")"
wait

# A killed holder leaves its turn to the processes that it started, and then to the next.
"$in_turn" "$build" bash -c 'touch "$1/third" && sleep 1 && rm "$1/third"' - "$build" 2>/dev/null &
until_there "$build/third"
kill -9 $!
"$in_turn" "$build" bash -c '[ ! -e "$1/third" ]' - "$build" || fail "beside what a killed one had started"

# A running copy is replaced.
mkdir "$build/bin"
cp "$(command -v sleep)" "$build/bin/sleeper"
"$in_turn" "$build" --keep "$build/run/own" sleeper -- true
"$build/run/own/sleeper" 60 &
sleeper=$!
"$in_turn" "$build" --keep "$build/run/own" sleeper -- true || fail "a copy that runs was not replaced"
kill "$sleeper"

# The copies come from one's own turn, however soon the next begins.
make_own() { "$in_turn" "$build" --keep "$build/run/$1" program -- bash -c 'echo "$1" >"$2/bin/program"' - "$1" "$build"; }
for name in {1..20}; do make_own "$name" & done
wait
for name in {1..20}; do [ "$(cat "$build/run/$name/program")" = "$name" ] || fail "another's program was kept"; done

# What builds behind gives way at once, in silence, and does not begin beside another.
mkdir "$build/behind"
"$in_turn" "$build" --behind bash -c 'touch "$1/begun"; trap "touch $1/ended; exit" TERM; sleep 600 9>&- & wait' - "$build/behind" &
until_there "$build/behind/begun"
"$in_turn" "$build" bash -c '[ -e "$1/ended" ]' - "$build/behind" 3>"$build/told" || fail "beside what builds behind"
[ ! -s "$build/told" ] || fail "told of what gives way: $(cat "$build/told")"
wait
[ ! -e "$build/.wanted" ] || fail "nobody waits, and .wanted stays"
"$in_turn" "$build" bash -c '"$1" "$2" --behind touch "$2/behind/beside"' - "$in_turn" "$build"
[ ! -e "$build/behind/beside" ] || fail "it began beside another"
# What somebody left who was killed while waiting ends nothing later.
touch "$build/.wanted"
"$in_turn" "$build" true
[ ! -e "$build/.wanted" ] || fail "a wish that nobody has any more stays"
"$in_turn" "$build" --behind touch "$build/behind/alone"
[ -e "$build/behind/alone" ] || fail "it does not begin alone"
