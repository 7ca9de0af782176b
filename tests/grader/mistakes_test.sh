#!/usr/bin/env bash
# mistakes_test.sh SOURCE: tables of mistakes are read as their reader (mistakes.awk) documents, and
# errors in one are reported with their lines.
set -euo pipefail
reader=$(readlink -f "$1")/tests/grader/mistakes.awk
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
mkdir -p solutions/01_sum/steps tests/01_sum/mistakes
table=tests/01_sum/mistakes/sums.txt
variants=tests/01_sum/variants.txt

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

cat >solutions/01_sum/steps/sum.cpp <<'END'
// The sum of 1 to n: a \& b.
int sum(int n) {
  int s = 0;

  for (int i = 1; i <= n; ++i)
    s += i;
  return s;
}
int twice(int n) {
  int s = 0;
  return s + 2 * n;
}
END

# mistake NAME ["changed lines"]: an entry.
mistake() { printf '== Lab 1.2 %s: off-by-one\nOne is missing.\n%s\n\n' "$1" "${2:--    s += i;}"; }
# in_file: the table of these entries.
in_file() { printf '= solutions/01_sum/steps/sum.cpp\n\n' && cat; }

# puts NAME SED: the solution with this mistake equals the solution edited by this sed script.
puts() {
  "$reader" put put.cpp "$table" "$1" || fail "$1 was refused"
  sed "$2" solutions/01_sum/steps/sum.cpp | diff - put.cpp || fail "$1 has another text"
}

# refused WORDS: the table is refused with these words, at the line in front of them.
refused() {
  ! "$reader" put_all out "$table" >words 2>&1 || fail "accepted in spite of \"$1\""
  grep -qF "$table:$1" words || fail "expected \"$1\", got: $(cat words)"
}

read_and_put() {
  {
    echo '# A comment.'
    mistake gone
    mistake added $'     s += i;\n+  ++s;'
    mistake above $'+#define X\n // The sum of 1 to n: a \\& b.'
    mistake twice $'-  int s = 0;\n-\n+  int s = 1;\n\n   return s + 2 * n;\n }\n+// \\& end'
    mistake neighbours $'-    s += i;\n+    s += 2;\n\n-  return s;\n+  return 2;'
  } | in_file >"$table"
  sed -i 's/ added: off-by-one/ added: crash, alone/' "$table"
  puts gone '/s += i;/d'
  puts added '/s += i;/a\  ++s;'
  puts above '1i #define X'
  puts twice $'3s/0/1/; 4d; $a// \\\\& end'
  puts neighbours 's/s += i;/s += 2;/; s/return s;/return 2;/'
  printf '== by_formula\nWithout a loop.\n-    s += i;\n' | in_file >"$variants"
  "$reader" list - "$table" "$variants" | sed -n '2p; $p' >listed
  printf 'solutions/01_sum/steps/sum.cpp\t%s\n' "added	$table	1.2	crash	alone" "by_formula	$variants" |
    diff - listed || fail "the list differs"
}

# Files that already have the right text are not touched.
unchanged_files_stay() {
  "$reader" put_all out "$table"
  touch -d 2001-01-01 out/*/steps/sum.cpp
  sed -i 's/^+  ++s;/+  --s;/' "$table"
  "$reader" put_all out "$table"
  [ "$(find out -name sum.cpp -newermt 2002-01-01)" = out/added/steps/sum.cpp ] || fail "other files were written"
  grep -q -e --s out/added/steps/sum.cpp || fail "a change was not written"
}

errors_are_told() {
  mistake gone $'-  s +=  i;' | in_file >"$table"
  refused '5: error: gone: these lines must occur exactly once in solutions/01_sum/steps/sum.cpp, but do not occur:'
  grep -qx '  s +=  i;' words || fail "the lines are not shown: $(cat words)"
  mistake gone $'-  int s = 0;' | in_file >"$table"
  refused '5: error: gone: these lines must occur exactly once in solutions/01_sum/steps/sum.cpp, but occur in lines 3 and 10:'
  mistake gone $'-  return s;\n\n-    s += i;' | in_file >"$table"
  refused '7: error: gone: this place is not below the one before it'
  mistake gone $'+  return s;' | in_file >"$table"
  refused '5: error: gone: what is added needs a line beside it that stays'
  mistake gone $'   return s;' | in_file >"$table"
  refused '5: error: gone: nothing is changed here'
  mistake gone $'-    s += i;\nreturn s;' | in_file >"$table"
  refused '6: error: a line of a change begins with -, + or a space: return s;'
  { mistake gone && mistake gone; } | in_file >"$table"
  refused "7: error: gone: the name is taken, $table:3"
  mistake gone | sed '/missing/d' | in_file >"$table"
  refused '3: error: gone: expected a sentence below the name'
  mistake gone | sed '/^-/d' | in_file >"$table"
  refused '3: error: gone: nothing is changed'
  mistake gone | sed 's/Lab //' | in_file >"$table"
  refused '3: error: expected "== Lab N.K name: diagnosis[, alone]": == 1.2 gone: off-by-one'
  mistake gone >"$table"
  refused '1: error: a line "= solutions/NN_name/FILE" must come first'
  mistake gone | in_file | sed 's/sum.cpp/product.cpp/' >"$table"
  refused '3: error: gone: there is no solutions/01_sum/steps/product.cpp'
  echo '-  return s;' | in_file >"$table"
  refused '3: error: this belongs to no mistake: -  return s;'
  ! "$reader" put - "$table" missing 2>words || fail "a mistake that is missing was put"
  grep -q 'there is no mistake "missing"' words || fail "got: $(cat words)"
}

read_and_put
unchanged_files_stay
errors_are_told
echo passed
