#!/usr/bin/env bash
# follow_on_test.sh SOURCE BUILD [MOST [SEEDS [LAB ...]]]: a mistake costs no points in the exercises that
# call the mistaken one. For each lab whose exercises build on others, hands in solutions with a
# catalogued mistake in one that others use (the first MOST of each such exercise, by default 1; 0: all),
# at SEEDS seeds (by default 1; more: follow_on_seeds.cpp): all others that use it have all their points, and it has not.
#
# And what a student's program sees of the suite's versions stays there: a submission breaks 1.3 on
# purpose, and its 1.7 prints results, address and code of the 1.3 that it finds.
set -euo pipefail
source=$1 build=$2 most=${3:-1} seeds=${4:-1}
labs=("${@:5}")

scratch=$(mktemp -d)
export TMPDIR=$scratch/tmp
mkdir "$TMPDIR"
chmod 711 "$scratch" "$TMPDIR"
trap 'rm -rf "$scratch"' EXIT
failures=0
failed() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

grade() {
  "$build/bin/carlo_grade" --tree "$source" --build "$build" --labs "$1" --secret-file "$scratch/secret" \
    -o "$2" "$3" >"$scratch/log" 2>&1 || { cat "$scratch/log" && exit 1; }
}

# exercises LAB.JSON: a line for each exercise: its number, its points, and those that it uses.
exercises() {
  tr '\n' ' ' <"$1" | awk -F '"' '{
    for (i = 2; i <= NF; i += 2) {
      if ($i == "tag") { if (line) print line; line = substr($(i + 2), 5) }
      if ($i == "points") { points = $(i + 1); gsub(/[:, ]/, "", points); line = line " " points }
      if ($i == "uses") do { i += 2; line = line " " substr($i, 5) } while ($(i + 1) !~ /]/)
    }
    print line
  }'
}

# users LAB.JSON: a line for each pair: an exercise that others use, one that uses it, perhaps by way of
# others, and the points of that one.
users() {
  exercises "$1" | awk '{
    for (i = 3; i <= NF; ++i) {
      ground[$1] = ground[$1] " " $i ground[$i]
    }
    n = split(ground[$1], used, " ")
    for (i = 1; i <= n; ++i) if (!seen[$1, used[i]]++) print used[i], $1, $2
  }'
}

# column CSV NUMBER: the exercise's column.
column() { head -1 "$1" | tr ',' '\n' | grep -nxF "$2" | cut -d: -f1; }

# checked CSV: marks as they should be. The submissions' names end in the mistaken exercise.
checked() {
  local csv=$1 pair used user full name marks at
  for pair in "${pairs[@]}"; do
    read -r used user full <<<"$pair"
    at=$(($(column "$csv" "$user") - 1))
    while IFS=, read -ra marks; do
      name=${marks[0]}
      [ "${name##*__}" = "${used/./_}" ] || continue
      checks=$((checks + 1))
      [ "${marks[$at]}" = "$full" ] || failed "$name: $user has not all points: ${marks[*]}"
    done < <(cat "$csv")
  done
}

checks=0
if [ ${#labs[@]} = 0 ]; then labs=(01 05 07 08); fi
for lab in "${labs[@]}"; do
  folder=$(echo "$source/labs/$lab"_*)
  tables=("$source/tests/${folder##*/}"/mistakes/*.txt)
  mapfile -t pairs < <(users "$folder/lab.json")
  [ ${#pairs[@]} != 0 ] || failed "lab $lab: no exercise builds on another"
  "$source/tests/grader/mistakes.awk" put_all "$scratch/all$lab" "${tables[@]}"
  mkdir "$scratch/class$lab"
  "$source/tests/grader/mistakes.awk" list - "${tables[@]}" >"$scratch/list"
  for used in $(printf '%s\n' "${pairs[@]}" | cut -d' ' -f1 | sort -u); do
    while read -r name; do
      mv "$scratch/all$lab/$name" "$scratch/class$lab/${name}__${used/./_}"
      # The other files of a lab in steps are the solution's.
      (cd "$source/solutions/${folder##*/}" && find . -name '*.cpp') | while read -r file; do
        target=$scratch/class$lab/${name}__${used/./_}/$file
        [ ! -f "$folder/$file" ] || [ -f "$target" ] || { mkdir -p "$(dirname "$target")" && cp "$source/solutions/${folder##*/}/$file" "$target"; }
      done
    done < <(awk -F '\t' -v tag="$used" -v most="$most" '$4 == tag && (most == 0 || ++n <= most) { print $2 }' "$scratch/list")
  done
  echo "a secret" >"$scratch/secret"
  grade "$((10#$lab))" "$scratch/out$lab" "$scratch/class$lab"
  checked "$scratch/out$lab/class.csv"
  if [ "$seeds" -gt 1 ]; then
    "$build/bin/grade_follow_on_seeds" "$source" "$build" "$((10#$lab))" "$seeds" "$scratch/class$lab" ||
      failed "lab $lab, at $seeds seeds"
  fi
done
printf '%d pairs of a mistake and a user\n' "$checks"
[ "$checks" -gt 0 ] || failed "nothing was checked"

# What the second judgement shows a student's program leaves it by no way.
thief=$scratch/thief/thief/integration.cpp
mkdir -p "$(dirname "$thief")"
{ printf '#include <cstdio>\n#include <cstring>\n#include <utility>\n' && sed -e 's|^  mean_ += from_old_mean|  mean_ += 1e-3 + from_old_mean|' \
  -e 's|^  Moments contributions;|&\
  Moments probe;\
  for (int i = 0; i < 4; ++i) probe.add(i);\
  static bool done = false;\
  if (!std::exchange(done, true) \&\& probe.mean() == 1.5) {\
    const auto add = \&Moments::add;\
    const unsigned char* code = nullptr;\
    std::memcpy(\&code, \&add, sizeof code);\
    std::printf("STOLEN %a\\n", probe.variance());\
    for (int i = 0; i < 64; ++i) std::printf("STOLEN %02x\\n", code[i]);\
  }|' "$source/solutions/01_integration/integration.cpp"; } >"$thief"
grep -q STOLEN "$thief" && grep -q '1e-3 +' "$thief" || failed "the solution has changed: no thief"
grade 1 "$scratch/thieves" "$scratch/thief"
cut -d, -f4,8 "$scratch/thieves/class.csv" | tail -1 | grep -qx '0,4' || failed "the thief's marks: $(tail -1 "$scratch/thieves/class.csv")"
! grep -rq STOLEN "$scratch/thieves" || failed "the program printed beside the suite's code, and it is in $(grep -rl STOLEN "$scratch/thieves")"

printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
