#!/usr/bin/env bash
# similarity_test.sh SOURCE BUILD: in a class of sixty, --similarity finds the planted copies of lab 1, puts no
# two independent solutions above them, survives hostile submissions, names whatever it does not compare, and
# changes no mark. Exit code 77: skipped; where CARLO_SIMILARITY_TESTS is "required" (.ci/run) that is a failure.
set -euo pipefail
source=$1
build=$2
here=$source/tests/grader/similarity

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

skip() {
  printf 'skipped: %s\n' "$*"
  [ "${CARLO_SIMILARITY_TESTS:-}" = required ] || exit 77
  fail "CARLO_SIMILARITY_TESTS is \"required\""
}

command -v node >/dev/null || skip "node is not installed (./carlo setup --developer)"
command -v npm >/dev/null || skip "npm is not installed (./carlo setup --developer)"
# As ./carlo grade --similarity does, which would also build every lab's judge.
packages=$source/build/similarity
if ! cmp -s "$here/package-lock.json" "$packages/node_modules/.installed"; then
  mkdir -p "$packages"
  cp "$here"/package*.json "$packages"
  (cd "$packages" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) || skip "npm cannot fetch Dolos"
  cp "$here/package-lock.json" "$packages/node_modules/.installed"
fi

scratch=$(mktemp -d)
export TMPDIR=$scratch/tmp
mkdir "$TMPDIR"
chmod 711 "$scratch" "$TMPDIR"
trap 'rm -rf "$scratch"' EXIT
class=$scratch/class

# hand_in NAME: makes standard input this student's file. It does not compile, which takes no time.
hand_in() {
  mkdir -p "$class/$1"
  { echo '#include "nowhere.h"' && cat; } >"$class/$1/integration.cpp"
}

# Other names, functions in reverse order, comments, other braces, s += x for s = s + x.
copy_of_second() {
  awk 'BEGIN { RS = ""; ORS = "\n\n" } { part[NR] = $0 }
       END { for (i = NR; i > 3; --i) print "// My own idea.\n" part[i] }' "$here/independent/second.cpp" |
    sed -E 's/\bs\b/acc/g; s/\bstep\b/delta/g; s/\bk\b/round/g; s/\bp\b/place/g; s/\bu\b/drawn/g
            s/([a-z]+) = \1 ([+*]) /\1 \2= /; s/^( *)(.*[^ ]) \{$/\1\2\n\1{/; s/double ([a-z]+) = /auto \1 = /'
}

# Other names, s = s + x for s += x, other casts.
copy_of_first() {
  sed -E 's/values/stats/g; s/point/pos/g; s/axis/dim/g; s/total/result/g; s/([a-z_]+) \+= /\1 = \1 + /
          s/double\(/static_cast<double>(/g; s/\/\/\/? .*//' "$here/independent/first.cpp"
}

# Two exercises of this one, the others from the suite.
copy_of_fourth() {
  awk '/^double midpoint/ { exit } { print }' "$here/independent/fourth.cpp"
  awk '/^double midpoint/ { on = 1 } on' "$source/solutions/01_integration/integration.cpp"
}

repeat() { printf "%.0s$1" $(seq "$2"); }

make_class() {
  local name
  for name in first second third fourth; do
    mkdir -p "$class/$name"
    cp "$here/independent/$name.cpp" "$class/$name/integration.cpp"
  done
  copy_of_first | hand_in copy_of_first
  copy_of_second | hand_in copy_of_second
  # Its comments are hostile where the page shows them.
  sed -E 's/sum_over/loop/g; s/\bat\b/g/g; s/^ +//; s|;$|; // </pre><script>alert(1)</script>|' \
    "$here/independent/third.cpp" | hand_in copy_of_third
  hand_in second_copy_of_third <"$here/independent/third.cpp"
  copy_of_fourth | hand_in copy_of_fourth
  hand_in stub <"$source/labs/01_integration/integration.cpp"
  head -c 20000 /dev/urandom | hand_in binary
  { echo 'int f() { return 1; }' && repeat '/* x ' 3000; } | hand_in unterminated
  { echo 'int f() { return' && repeat '(' 90000; } | hand_in deep
  repeat 'x = x + 1;' 2000 | hand_in repeats
  repeat 'int x;\n' 40000 | hand_in huge
  mkdir -p "$class/linked"
  ln -s /etc/passwd "$class/linked/integration.cpp"
  "$source/tests/grader/mistakes.awk" put_all "$scratch/mistakes" "$source"/tests/01_integration/mistakes/*.txt
  for name in $(cd "$scratch/mistakes" && find . -mindepth 1 -maxdepth 1 -printf '%f\n' | LC_ALL=C sort | sed -n 1,44p); do
    hand_in "$name" <"$scratch/mistakes/$name/integration.cpp"
  done
}

grade=("$build/bin/carlo_grade" --tree "$source" --build "$build" "$class" --labs 1 -j 2
  --secret-file "$scratch/secret" -o "$scratch/out")
csv=$scratch/out/similarity.csv page=$scratch/out/similarity.html

# of NAME NAME: prints the pair's similarity, then its remark.
of() { awk -F, -v a="$1" -v b="$2" '($2 == a && $3 == b) || ($2 == b && $3 == a) { print $4, $7 }' "$csv"; }

make_class
[ "$(find "$class" -mindepth 1 -maxdepth 1 | wc -l)" = 60 ] || fail "this is no class of sixty"
echo 'a secret of this test' >"$scratch/secret"
chmod 600 "$scratch/secret"
"${grade[@]}" >"$scratch/log" 2>&1 || fail "the grader ended with $?: $(tail -n 3 "$scratch/log")"
for name in first second third fourth; do
  grep -q "^$name,.*,20,20,graded" "$scratch/out/class.csv" || fail "$name is not right"
done
cp "$scratch/out"/class.{csv,html} "$scratch"

start=$(date +%s%N)
"${grade[@]}" --similarity >"$scratch/log" 2>&1 || fail "--similarity ended with $?: $(tail -n 3 "$scratch/log")"
printf 'sixty submissions, marks as before: %d ms\n' $((($(date +%s%N) - start) / 1000000))
cmp "$scratch/class.csv" "$scratch/out/class.csv" || fail "--similarity changes class.csv"
cmp "$scratch/class.html" "$scratch/out/class.html" || fail "--similarity changes class.html"

highest=$(for a in first second third fourth; do
  for b in first second third fourth; do of "$a" "$b"; done
done | LC_ALL=C sort -rn | head -n 1 | cut -d' ' -f1)
printf 'independent solutions: at most %s\n' "$highest"
for name in first second third fourth; do
  read -r similarity remark < <(of "$name" "copy_of_$name")
  printf 'copy of the %s: %s %s\n' "$name" "$similarity" "$remark"
  [ "$remark" = 'stands out' ] || fail "nobody finds the copy of the $name solution"
  awk "BEGIN { exit !($similarity > 2 * $highest) }" || fail "independent solutions are as similar as a copy"
done
awk -F, '$7 == "stands out" { print $2; print $3 }' "$csv" | sort -u >"$scratch/named"
! grep -vE '^(first|second|third|fourth|(second_)?copy_of_.*)$' "$scratch/named" || fail "others stand out, too"
for name in "$class"/*; do
  grep -q ",$(basename "$name")," "$csv" || fail "$(basename "$name") is missing in similarity.csv"
done
for name in binary unterminated deep repeats huge linked stub; do
  grep -E "^01_integration,$name,,,,,not compared: " "$csv" || fail "$name is compared"
done
grep -q '&lt;script&gt;alert' "$page" || fail "the page does not show the hostile markup as text"
! grep -q '<script>alert' "$page" || fail "a submission's script is in the page"
! grep -qE '(src|href)="?(https?:)?//' "$page" || fail "the page needs another host"

"${grade[@]}" --similarity --no-names >"$scratch/log" 2>&1 || fail "--no-names ended with $?"
! grep -qE 'copy_of_|sum_over' "$page" || fail "--no-names leaves names or code in the page"

mkdir "$scratch/bin"
printf '#!/bin/sh\nexit 3\n' >"$scratch/bin/node"
chmod +x "$scratch/bin/node"
rm "$scratch/out/class.csv"
! PATH=$scratch/bin:$PATH "${grade[@]}" --similarity >"$scratch/log" 2>&1 || fail "a failed comparison does not matter"
grep -q 'comparing failed.*all marks are kept' "$scratch/log" || fail "nobody says so: $(cat "$scratch/log")"
cmp "$scratch/class.csv" "$scratch/out/class.csv" || fail "a failed comparison costs marks"
[ -z "$(ls -A "$TMPDIR")" ] || fail "left behind: $(ls "$TMPDIR")"
echo passed
