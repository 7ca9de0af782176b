#!/usr/bin/env bash
# tidy.sh [--all]: clang-tidy of what the last ten commits changed (.ci/run), without its analyser; or of
# everything, with it (tests/nightly.sh). Files that are compiled together are looked at together: most
# of the time goes into the headers that they share. What was clean is not looked at again until
# something that it includes changes ($XDG_CACHE_HOME/carlo/tidy, or ~/.cache). Exit code 0: all clean.
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/..")
cd "$root"
case ${1:-} in
  '') checks='-clang-analyzer-*' ;;
  --all) checks='' ;;
  --help | -h)
    sed -n '2,/^set/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" | sed '$d'
    exit ;;
  *) printf 'tidy: it takes --all only, got %s\n' "$1" >&2 && exit 1 ;;
esac
CHECKS=$checks
CACHE=${XDG_CACHE_HOME:-$HOME/.cache}/carlo/tidy
mkdir -p "$CACHE"
cmake --preset ci -B build/tidy >/dev/null

# Prints file<TAB>command of everything compiled, each file once. Excludes stubs, which have unused
# parameters, stb, which is not ours, and files of the build folder except those that include
# others.
compiled() {
  awk -F'": "' '
    /^ *"command"/ { sub(/",?$/, "", $2); command = $2; gsub(/\\"/, "\"", command) }
    /^ *"file"/ { sub(/",?$/, "", $2); if (!seen[$2]++) print $2 "\t" command }' build/tidy/compile_commands.json |
    while IFS=$'\t' read -r file command; do
      case $file in
        */common/image/stb.cpp) continue ;;
        "$root/build/tidy/together/"*) ;;
        "$root/build/"*) continue ;;
      esac
      grep -q 'not_implemented("' "$file" || printf '%s\t%s\n' "$file" "$command"
    done
}

# Keeps those lines of compiled() for which a source has changed.
changed() {
  local base file command parts holds
  base=$(git rev-parse -q --verify 'HEAD~10') || base=$(git rev-list --max-parents=0 HEAD | tail -n 1)
  parts=$(git diff --name-only --diff-filter=d "$base" -- '*.cpp')
  while IFS=$'\t' read -r file command; do
    # Not by a pipe: grep ends at the first match, and whoever writes to it then fails.
    holds=$(sed -n 's/^#include "\([^"]*\.cpp\)".*/\1/p' "$file" && printf '%s\n' "${file#"$root/"}")
    if grep -qxF "$parts" <<<"$holds"; then printf '%s\t%s\n' "$file" "$command"; fi
  done
  return 0
}

# look FILE<TAB>COMMAND: prints clang-tidy's findings.
look() {
  local file=${1%%$'\t'*} command=${1#*$'\t'} key
  command=${command% -o *}
  key=$( (cd build/tidy && $command -E -C "$file" 2>/dev/null; cat "$OLDPWD/.clang-tidy"; clang-tidy --version; printf '%s\n' "$CHECKS") |
    sed "s#$PWD##g" | sha256sum | cut -d' ' -f1)
  [ ! -e "$CACHE/$key" ] || return 0
  clang-tidy -p build/tidy --quiet ${CHECKS:+"--checks=$CHECKS"} "$file" 2>/dev/null || return
  : >"$CACHE/$key"
}
export -f look
export CHECKS CACHE

if [ "${1:-}" = --all ]; then compiled; else compiled | changed; fi | tr '\n' '\0' |
  xargs -0 --no-run-if-empty -P2 -I{} bash -c 'look "$1"' look {}
