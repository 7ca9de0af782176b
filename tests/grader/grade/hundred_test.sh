#!/usr/bin/env bash
# hundred_test.sh SOURCE BUILD WORK: grades a class of a hundred in all labs: right answers, stubs,
# typical mistakes and attacks. The marks are those deserved; a grader that is killed half-way and
# restarted produces the same CSV as one that was left alone. Prints seconds and memory.
set -euo pipefail
source=$(readlink -f "$1")
build=$(readlink -f "$2")
work=$3

labs=(01_integration 02_pi 03_rng 04_stratification 05_inversion_rejection 06_importance
  07_hemisphere 08_path_tracer 09_bias)
# Includes attacks that fill the disk, the memory or the process table; compiler bombs take long.
attacks=exits,crashes,hangs,memory,processes,floods,disk,fake_reports,forged_frames,results_written
attacks+=,strange_values,other_processes,network,reads_answers,includes_solution,syntax_error
attacks+=,odd_names,zip_paths_out,knows_the_lists,exit_before_main

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# take NAME FROM LAB: this student hands in the lab's exercise files from FROM/.
take() {
  local from=$source/$2/$3 to=$class/$1/labs/$3
  mkdir -p "$to"
  if [ -d "$from/steps" ]; then cp -r "$from/steps" "$to/"; else cp "$from/${3#*_}.cpp" "$to/"; fi
}

# Two labs each, so that every lab has several submissions.
make_students() {
  local i
  for i in 0 1; do
    for lab in "${labs[@]}"; do take "all_right_$i" solutions "$lab"; done
  done
  for i in $(seq 10 31); do
    take "right_$i" solutions "${labs[$((i % 8))]}"
    take "right_$i" solutions "${labs[$(((i + 3) % 8))]}"
  done
  for i in $(seq 10 25); do
    take "stub_$i" labs "${labs[$((i % 8))]}"
    take "stub_$i" labs "${labs[$(((i + 5) % 8))]}"
  done
}

# Forty of the catalogue, evenly spaced.
make_mistaken() {
  local mistakes solution name table exercise i reader=$source/tests/grader/mistakes.awk
  mapfile -t mistakes < <("$reader" list - "$source"/tests/*/mistakes/*.txt | LC_ALL=C sort)
  for i in $(seq 0 39); do
    IFS=$'\t' read -r solution name table exercise _ <<<"${mistakes[$((i * ${#mistakes[@]} / 40))]}"
    take "mistaken_$i" solutions "$(cut -d/ -f2 <<<"$solution")"
    "$reader" put "$class/mistaken_$i/labs/${solution#solutions/}" "$table" "$name"
    printf 'mistaken_%s %s\n' "$i" "$exercise"
  done >"$work/mistaken.txt"
}

# column CSV NAME: prints the numbers of that column of class.csv, by student.
column() {
  awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i; next }
                        { print $1, $c }' "$1"
}

check_marks() {
  local csv=$1 name points exercise full
  while read -r name points; do
    [ "$(column "$csv" total | awk -v n="$name" '$1 == n { print $2 }')" = "$points" ] ||
      fail "$name does not have the $points points of its honest part"
  done <"$work/attacks.txt"
  column "$csv" total | grep '^stub_' | grep -vq ' 0$' && fail "a stub has points"
  # A student who handed in two labs has their sum; the others' tricks lose nothing.
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^lab /) is[i] = 1; next }
           $1 ~ /right_/ { for (i in is) if ($i > full[i]) full[i] = $i }
           { row[NR] = $0 }
           END { for (r in row) { n = split(row[r], f, ","); if (f[1] !~ /right_/) continue
                   for (i in is) if (f[i] != 0 && f[i] != full[i]) { print f[1]; bad = 1 } }
                 exit bad }' "$csv" || fail "right answers have less than all points"
  [ "$(column "$csv" total | awk '/^all_right/ { print $2 }' | sort -u)" = \
    "$(column "$csv" max | awk '/^all_right/ { print $2 }' | sort -u)" ] || fail "all_right lost points"
  while read -r name exercise; do
    full=$(column "$csv" "$exercise" | awk '/^all_right_0 / { print $2 }')
    column "$csv" "$exercise" | awk -v n="$name" -v full="$full" \
      '$1 == n { found = 1; good = $2 < full } END { exit !(found && good) }' ||
      fail "$name has all points of $exercise, which is wrong"
  done <"$work/mistaken.txt"
}

records() { find "$1" -name record.json 2>/dev/null | wc -l; }

# Prints, by lab, what compiling and judging a submission takes.
print_timing() {
  awk -F, 'NR > 1 && $3 + $4 > 0 {
      n[$2]++; c[$2] += $3; j[$2] += $4; t = $3 + $4; if (t > worst[$2]) worst[$2] = t
      m = $5 > $6 ? $5 : $6; if (m > peak[$2]) peak[$2] = m }
    END { print "lab submissions  compile s  judge s  worst s  peak MB (means; compiling and judging)"
          for (l = 1; l <= 8; ++l) if (n[l])
            printf "%3d %11d %10.1f %8.1f %8.1f %8d\n", l, n[l], c[l] / n[l], j[l] / n[l], worst[l], peak[l] }' \
    "$1/timing.csv"
}

"$build/bin/carlo_attacks" --attacks "$source/tests/grader/attacks" --tree "$source" \
  --build "$build" --work "$work" --prepare --only "$attacks" >"$work.attacks"
mv "$work.attacks" "$work/attacks.txt"
class=$work/class
make_students
make_mistaken
members=$(find "$class" -mindepth 1 -maxdepth 1 | wc -l)
[ "$members" = 100 ] || fail "the class has $members members"
echo 'a secret of this test' >"$work/secret"
chmod 600 "$work/secret"

grade=("$build/bin/carlo_grade" --tree "$source" --build "$build" "$class" -j 2
  --secret-file "$work/secret" -o)
start=$SECONDS
"${grade[@]}" "$work/out" >"$work/whole.log" 2>&1 || fail "the grader ended with $? (whole.log)"
printf 'undisturbed: %d submissions in %d s\n' "$members" "$((SECONDS - start))"
print_timing "$work/out"
check_marks "$work/out/class.csv"

start=$SECONDS
setsid "${grade[@]}" "$work/killed" >"$work/killed.log" 2>&1 &
grader=$!
while [ "$(records "$work/killed")" -lt 50 ] && kill -0 "$grader"; do sleep 0.2; done
kill -9 "$grader"
wait "$grader" 2>/dev/null || true
[ ! -e "$work/killed/class.csv" ] || fail "it was done before it could be killed"
printf 'killed after %d s with %d records\n' "$((SECONDS - start))" "$(records "$work/killed")"
"${grade[@]}" "$work/killed" >"$work/resumed.log" 2>&1 || fail "resumed, it ended with $?"
[ "$(grep -c 'as before' "$work/resumed.log")" -ge 50 ] || fail "what was graded was graded again"
cmp "$work/out/class.csv" "$work/killed/class.csv" || fail "the interrupted run's CSV differs"
printf 'resumed: the same CSV, after %d s in all\n' "$((SECONDS - start))"
