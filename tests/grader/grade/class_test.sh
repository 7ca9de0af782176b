#!/usr/bin/env bash
# class_test.sh SOURCE BUILD: grades a small class in lab 1: the marks are right, nothing outside
# the class is read or written, and a killed grader resumes, produces the same CSV, and leaves no
# process or file behind.
set -euo pipefail
source=$1
build=$2

scratch=$(mktemp -d)
export TMPDIR=$scratch/tmp
mkdir "$TMPDIR"
chmod 711 "$scratch" "$TMPDIR"
trap 'rm -rf "$scratch"' EXIT
class=$scratch/class
solution=$source/solutions/01_integration/integration.cpp

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# member NAME: the file that this student hands in.
member() {
  mkdir -p "$class/$1"
  printf '%s/integration.cpp' "$class/$1"
}

make_class() {
  mkdir -p "$class/right/labs/01_integration"
  cp "$solution" "$class/right/labs/01_integration/"
  cp "$source/labs/01_integration/integration.cpp" "$(member stub)"
  "$source/tests/grader/mistakes.awk" put "$(member mistaken)" \
    "$source/tests/01_integration/mistakes/average.txt" average_by_n_plus_one
  { cat "$solution" && echo 'int broken( {'; } >"$(member uncompiled)"
  printf '#include "%s"\n' ../../solutions/01_integration/integration.cpp >"$(member relative)"
  printf '#include "%s"\n' "$solution" >"$(member thief)"
  cp "$solution" "$(member twice)"
  mkdir "$class/twice/old"
  echo 'int x;' >"$class/twice/old/integration.cpp"
  mkdir "$class/nothing"
  echo 'see my e-mail' >"$class/nothing/README.txt"
  mkdir "$class/linked"
  ln -s "$solution" "$class/linked/integration.cpp"
  # Packed on Windows, with entries that lead out of the archive.
  mkdir -p "$scratch/pack/inner"
  sed 's/$/\r/' "$solution" >"$scratch/pack/inner/integration.cpp"
  echo stolen >"$scratch/pack/escaped.txt"
  (cd "$scratch/pack/inner" && tar --absolute-names -czf "$class/packed.tar.gz" \
    ../escaped.txt integration.cpp)
  rm "$scratch/pack/escaped.txt"
}

grade=("$build/bin/carlo_grade" --tree "$source" --build "$build" "$class" --labs 1 -j 2
  --secret-file "$scratch/secret" -o)

expected() {
  cat <<'EOF'
linked,0,20,lab 1 not submitted
mistaken,18,20,1.2 right by itself
nothing,0,20,lab 1 not submitted
packed,20,20,graded
relative,0,20,lab 1 does not compile
right,20,20,graded
stub,0,20,graded
thief,0,20,lab 1 does not compile
twice,0,20,lab 1 refused
uncompiled,0,20,lab 1 does not compile
EOF
}

marks() { tail -n +2 "$1/class.csv" | cut -d, -f1,10-12; }

check_marks() {
  diff <(expected) <(marks "$1") || fail "the marks in $1 are not those expected"
}

make_class
# Without confinement, submissions would run as root.
if [ "$(id -u)" = 0 ]; then
  ! "${grade[@]}" "$scratch/unsafe" --sandbox limits >"$scratch/log" 2>&1 ||
    fail 'root grades at the level "limits"'
  grep -q 'would run as root' "$scratch/log" || fail "nobody says why root may not: $(cat "$scratch/log")"
fi
echo 'a secret of this test' >"$scratch/secret"
chmod 600 "$scratch/secret"

"${grade[@]}" "$scratch/whole" | tee "$scratch/log" || fail "the grader ended with $?"
if grep -q 'sandbox: limits\|sandbox: user' "$scratch/log"; then
  echo 'SKIPPED: no sandbox here hides the solutions'
  exit 0
fi
check_marks "$scratch/whole"
for file in results.json junit.xml report.txt record.json; do
  [ -s "$scratch/whole/right/$file" ] || fail "right/$file is missing"
done
grep -q 'integration.cpp:[0-9]*:[0-9]*: error' "$scratch/whole/uncompiled/report.txt" ||
  fail "the report does not show the compiler's error"
grep -q 'differ: which one is meant' "$scratch/whole/twice/report.txt" ||
  fail "nobody says that two files differ"
grep -q 'leads out of the archive' "$scratch/whole/packed/report.txt" ||
  fail "nobody says that an entry leads out of its archive"
[ ! -e "$scratch/pack/escaped.txt" ] || fail "an archive wrote outside of itself"

grep -q '^packed,.*,"./packed.tar.gz"$' "$scratch/whole/class.csv" ||
  fail "the CSV does not say where a submission was found"

# Marks among submissions would be taken for one.
! "${grade[@]}" "$class/grades" >"$scratch/log" 2>&1 || fail "marks may be written into the class"
grep -q 'would be a submission next time' "$scratch/log" || fail "nobody says why: $(cat "$scratch/log")"
[ ! -e "$class/grades" ] || fail "the refused folder was made"

# Two students whose names become equal: the marks show whose they are, and the exit code reports
# it.
mkdir -p "$scratch/alike/a b" "$scratch/alike/a_b"
touch "$scratch/alike/a b/README.txt" "$scratch/alike/a_b/README.txt"
! "$build/bin/carlo_grade" --tree "$source" --build "$build" "$scratch/alike" --labs 1 \
  --secret-file "$scratch/secret" -o "$scratch/names" >"$scratch/log" 2>&1 ||
  fail "names that collide do not matter"
grep -q 'a b is graded as a_b-2: another submission has its name' "$scratch/log" ||
  fail "nobody says whose name is changed: $(cat "$scratch/log")"
grep -q '^a_b,.*,"./a_b"$' "$scratch/names/class.csv" || fail "a name is not whose own it is"
grep -q '^a_b-2,.*,"./a b"$' "$scratch/names/class.csv" || fail "the CSV does not say who a_b-2 is"

# Killed as soon as there are some marks, then restarted.
"${grade[@]}" "$scratch/killed" >/dev/null 2>&1 &
grader=$!
for _ in $(seq 6000); do
  [ "$(find "$scratch/killed" -name record.json 2>/dev/null | wc -l)" -lt 4 ] || break
  sleep 0.1
done
kill -9 "$grader"
wait "$grader" 2>/dev/null || true
[ ! -e "$scratch/killed/class.csv" ] || fail "it was done before it could be killed"
for _ in $(seq 100); do
  pgrep -f "$scratch" >/dev/null || break
  sleep 0.1
done
! pgrep -fa "$scratch" || fail "processes outlived the grader"
"${grade[@]}" "$scratch/killed" | tee "$scratch/log"
grep -q 'as before' "$scratch/log" || fail "what was graded was graded again"
for file in class.csv class.html; do
  cmp "$scratch/whole/$file" "$scratch/killed/$file" || fail "the interrupted run's $file differs"
done
[ -z "$(ls -A "$TMPDIR")" ] || fail "left behind: $(ls "$TMPDIR")"

# Unchanged: nothing to do. A changed file: only that one is graded again.
echo '// changed' >>"$class/stub/integration.cpp"
"${grade[@]}" "$scratch/whole" >"$scratch/log"
[ "$(grep -c 'as before' "$scratch/log")" = 9 ] || fail "what has not changed was graded again"
echo 'another secret' >"$scratch/secret"
rm -r "$class"/{packed.tar.gz,mistaken,right}
"${grade[@]}" "$scratch/whole" >"$scratch/log"
! grep -q 'as before' "$scratch/log" || fail "another secret left marks as they were"
echo passed
