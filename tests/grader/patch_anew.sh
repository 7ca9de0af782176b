#!/usr/bin/env bash
# patch_anew.sh PATCH...: updates patches of tests/*/mistakes and tests/*/variants that no longer
# apply because the solution has changed next to the lines that they change. Their headers stay as
# they are. A patch whose own lines have changed is reported and left alone.
set -euo pipefail
[ $# != 0 ] || { sed -n '2,4s/^# //p' "$0" && exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$(cd "$(dirname "$0")/../.." && pwd)
failed=0
for patch in "$@"; do
  solution=$(sed -n 's#^+++ b/##p' "$patch" | head -n 1 | cut -f 1)
  [ -f "$root/$solution" ] || { printf '%s: no solution %s\n' "$patch" "$solution" >&2 && exit 1; }
  if ! patch --quiet --fuzz=3 --no-backup-if-mismatch --reject-file=- "--output=$work/patched" \
    "$root/$solution" "$patch" >"$work/words" 2>&1; then
    printf '%s: its own lines have changed, write it anew: %s\n' "$patch" "$(tr '\n' ' ' <"$work/words")" >&2
    failed=1
    continue
  fi
  {
    sed '/^--- a\//,$d' "$patch"
    diff -u --label "a/$solution" --label "b/$solution" "$root/$solution" "$work/patched" || true
  } >"$work/anew"
  cat "$work/anew" >"$patch"
done
exit $failed
