#!/usr/bin/env bash
# leaks.sh SUITE TREE K: checks that TREE, a students' tree, contains no line of the solutions of
# lab K and later. A line counts if it has more than 20 characters, is no #include, is not in the
# stub and is not in known_lines.txt, lines that anybody would write. Prints the leaks; exit code 1
# then.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
suite=$1 tree=$2 first=$3

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

lines_of() { sed 's/^[ \t]*//; s/[ \t]*$//' "$1" | LC_ALL=C sort -u; }
grep -vE '^(#|$)' "$here/known_lines.txt" >"$scratch/known"

looked_at=0 leaks=0
for solution in "$suite"/solutions/[0-9]*/*.cpp "$suite"/solutions/[0-9]*/steps/*.cpp; do
  file=${solution#"$suite"/solutions/}
  stub=$suite/labs/$file
  [ "$((10#${file%%_*}))" -ge "$first" ] && [ -f "$stub" ] || continue
  LC_ALL=C comm -23 <(lines_of "$solution") <(lines_of "$stub") | awk 'length($0) > 20' |
    grep -v '^#include' | grep -vxE -f "$scratch/known" >"$scratch/lines"
  looked_at=$((looked_at + $(wc -l <"$scratch/lines")))
  if grep -rnoF -f "$scratch/lines" "$tree" >"$scratch/found"; then
    sed "s|^$tree/|FAILED: a line of solutions/$file stands in |" "$scratch/found"
    leaks=$((leaks + $(wc -l <"$scratch/found")))
  fi
done

# An empty list would find nothing, whatever the tree contains.
[ "$looked_at" -ge 40 ] || { printf 'FAILED: only %d lines looked for\n' "$looked_at" && exit 1; }
printf 'labs from %d on: %d lines of solutions looked for, %d found\n' "$first" "$looked_at" "$leaks"
[ "$leaks" = 0 ]
