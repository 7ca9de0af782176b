#!/usr/bin/env bash
# make.sh [--OPTION=VALUE ...] [SCENE ...]: renders the reference images of common/scenes again (all
# of them, or those named) and prints their table; if all are made, it puts the table into
# README.md.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$here/../..
build=$root/build/release

[ -f "$build/build.ninja" ] || (cd "$root" && cmake --preset release >/dev/null)
ninja -C "$build" --quiet carlo_references >&2
table=$(mktemp)
trap 'rm -f "$table" "$table.md"' EXIT
nice "$build/bin/carlo_references" --folder "$here" "$@" | tee "$table"

named=
for argument in "$@"; do
  case $argument in
    --help | -h) named=1 ;;
    -*) ;;
    *) named=1 ;;
  esac
done
if [ -z "$named" ]; then
  awk -v table="$table" '
    /^<!-- table -->$/ { print; while ((getline line < table) > 0) print line; skip = 1; next }
    /^<!-- end of table -->$/ { skip = 0 }
    !skip' "$here/README.md" >"$table.md"
  cp "$table.md" "$here/README.md"
fi
