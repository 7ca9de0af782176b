#!/usr/bin/env bash
# bench_page_test.sh BENCH SOURCE: a part of `./carlo bench` writes a page and the same numbers as
# JSON; impossible requests give an error of one line and no page.
set -euo pipefail
bench=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tree=(--scenes "$source/common/scenes" --references "$source/tests/references/scenes"
  --scratch "$scratch")

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# expect_error PATTERN ARGUMENTS...
expect_error() {
  local pattern=$1 code=0
  shift
  "$bench" "$@" --page "$scratch/bad.html" >/dev/null 2>"$scratch/stderr" || code=$?
  [ "$code" = 1 ] || fail "exit code $code for: $*"
  [ "$(wc -l <"$scratch/stderr")" = 1 ] || fail "not one line for $*: $(cat "$scratch/stderr")"
  grep -Eq "$pattern" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' is not '$pattern'"
  [ ! -e "$scratch/bad.html" ] || fail "a page in spite of an error: $*"
}

"$bench" "${tree[@]}" --only equal-time --page "$scratch/new/page.html" >"$scratch/table" ||
  fail "exit code $?"
for way in 'recursive' 'iterative' 'reference, scalar' 'reference, vector'; do
  awk -v way="$way" 'index($0, way) == 1 { found = $NF > 0 } END { exit !found }' "$scratch/table" ||
    fail "no error of $way: $(cat "$scratch/table")"
  grep -q "\"way\": \"$way" "$scratch/new/page.json" || fail "$way is not in the JSON file"
done
grep -q 'class="viewer"' "$scratch/new/page.html" || fail 'the page shows no images'
grep -q 'bench --only equal-time --seed 1' "$scratch/new/page.html" || fail 'the page has no command'

expect_error 'nonsense' "${tree[@]}" --only nonsense
expect_error 'no_such' --only equal-time --scenes "$scratch/no_such"
