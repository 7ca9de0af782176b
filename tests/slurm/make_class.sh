#!/usr/bin/env bash
# make_class.sh SOURCE BUILD WORK [RIGHT MISTAKEN ATTACKS]: makes a test class in WORK/class: so
# many (60, 100, 40) right answers of all labs, typical mistakes, and attacks on the grader, one lab
# each. Only attacks that end soon, including those that fill disk, memory or the process table.
# Replaces WORK.
set -euo pipefail
source=$(readlink -f "$1") build=$(readlink -f "$2") work=$3
right=${4:-60} mistaken=${5:-100} attackers=${6:-40}

labs=(01_integration 02_pi 03_rng 04_stratification 05_inversion_rejection 06_importance
  07_hemisphere 08_path_tracer 09_bias)
attacks=(exits fake_reports syntax_error crashes zip_paths_out spoilt_archive memory processes disk floods
  hangs forged_frames results_written strange_values other_processes network reads_answers
  includes_solution odd_names knows_the_lists exit_before_main asks_for_solution assembler_reads
  constructor_attribute defines_main disk_at_once huge_file line_directive_shows line_ends links
  links_in_tar long_line messages_in_xml paths_out replaces_files replaces_new signals_by_descriptor
  steals_work two_candidates writes_settings)

# take NAME LAB: this student hands in the lab's solution.
take() {
  local from=$source/solutions/$2 to=$work/class/$1/labs/$2
  mkdir -p "$to"
  if [ -d "$from/steps" ]; then cp -r "$from/steps" "$to/"; else cp "$from/${2#*_}.cpp" "$to/"; fi
}

[ "$attackers" -le ${#attacks[@]} ] || { printf 'make_class: there are %d attacks\n' ${#attacks[@]} >&2 && exit 1; }
if [ "$attackers" != 0 ]; then
  only=$(IFS=, && printf '%s' "${attacks[*]:0:attackers}")
  "$build/bin/carlo_attacks" --attacks "$source/tests/grader/attacks" --tree "$source" \
    --build "$build" --work "$work" --prepare --only "$only" >/dev/null
fi
for ((i = 0; i < right; ++i)); do take "right_$i" "${labs[i % ${#labs[@]}]}"; done

# Mistakes of the whole catalogue, evenly spaced.
reader=$source/tests/grader/mistakes.awk
mapfile -t mistakes < <("$reader" list - "$source"/tests/*/mistakes/*.txt | LC_ALL=C sort)
for ((i = 0; i < mistaken; ++i)); do
  IFS=$'\t' read -r solution name table _ <<<"${mistakes[i * ${#mistakes[@]} / mistaken]}"
  take "mistaken_$i" "$(cut -d/ -f2 <<<"$solution")"
  "$reader" put "$work/class/mistaken_$i/labs/${solution#solutions/}" "$table" "$name"
done
