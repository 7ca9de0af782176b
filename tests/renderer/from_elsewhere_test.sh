#!/usr/bin/env bash
# from_elsewhere_test.sh PROGRAM SCENE: carlo_render without an instruction set of this machine says
# in one line what to do, writes nothing, and renders by the scalar kernel.
set -euo pipefail
program=$1 scene=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  printf 'from_elsewhere: %s\n' "$*" >&2
  exit 1
}

arguments=("$scene" --size 16x16 --spp 4)
code=0
"$program" "${arguments[@]}" -o "$folder/best" 2>"$folder/said" >&2 || code=$?
[ "$code" != 0 ] || fail "it rendered by a kernel that it does not have"
[ "$(wc -l <"$folder/said")" = 1 ] || fail "not one line: $(cat "$folder/said")"
for words in 'another kind of processor' 'CARLO_EVERY_INSTRUCTION_SET=ON' '--kernel scalar'; do
  grep -q -e "$words" "$folder/said" || fail "it does not say '$words': $(cat "$folder/said")"
done
[ "$(cd "$folder" && echo *)" = said ] || fail "it wrote $(cd "$folder" && echo *)"

"$program" "${arguments[@]}" --kernel scalar -o "$folder/scalar" >/dev/null 2>&1 || fail "the scalar kernel does not render"
[ -s "$folder/scalar.exr" ] || fail "the scalar kernel wrote no image"
