#!/usr/bin/env bash
# Makes the students' archive; ./carlo starter. See usage.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../../..")

usage() {
  cat <<'END'
usage: ./carlo starter --through K [-o FILE.tar.gz|FILE.zip] [--dirty]

Writes the students' archive of labs 1 to K (default out/carlo_labs_1_to_K.tar.gz): these labs as
stubs, the solutions of the labs before K (later labs build on them), the library, the judge, and the
slides' formulas that handouts and hints cite (labs/formulas.md). No solution of lab K or later is in
it, no table of typical mistakes, no reference image, nothing of the class's grading.

The judge has to work out what is right, so tests/NN_name/*.h and *.cpp hold code that a student could
learn an exercise from: of labs 1 to 9 that of 2.1, 2.3, 2.5 and 2.6 (tests/02_pi/reference.h), the
inversions of 5.1 and 5.2, the density of 6.3, Phong's f and pdf (tests/08_path_tracer/theory.h), the
formulas of 9.1 (tests/09_bias/checks_error.cpp), the filters of 9.2 and 9.3 (pixel_filter_theory.h,
feature_theory.h) and the interpolation of 9.7 (irradiance_theory.h), and everywhere the values that
typical mistakes would give. Whoever reads these has looked an answer up.

It is made from what is committed, and the same commit gives the same bytes.

  --dirty   take uncommitted changes too
END
}

. "$here/tree.sh"

last='' file='' dirty=''
while [ $# != 0 ]; do
  case $1 in
    --help | -h) usage && exit ;;
    --dirty) dirty=yes ;;
    --through | -o | --output)
      [ $# -gt 1 ] || fail "$1 needs a value (see ./carlo starter --help)"
      if [ "$1" = --through ]; then last=$2; else file=$2; fi
      shift ;;
    *) fail "starter does not know '$1' (see ./carlo starter --help)" ;;
  esac
  shift
done
last=$(lab_number "$root" "$last" "starter needs the last lab that students get, such as --through 3")
file=${file:-$root/out/carlo_labs_1_to_$last.tar.gz}
check_output "$file"
committed_tree "$root" "$dirty"
need_for "$root" "$file"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tree=$scratch/carlo
mkdir "$tree"
student_files "$root" "$last" | tar -C "$root" -c --files-from=- | tar -C "$tree" -x
holds='lab 1'
[ "$last" = 1 ] || holds="labs 1 to $last, and the solutions of the labs before lab $last"
"$here/formulas.sh" "$root" "$last" >"$tree/labs/formulas.md"
sed "s/@HOLDS@/$holds/" "$here/student_readme.md" >"$tree/README.md"
plain_rights "$scratch"
pack "$scratch" "$file" "$(git -C "$root" log -1 --format=%ct)"
printf 'carlo: wrote %s (%s files, %s KB): %s\n' "$file" "$(find "$tree" -type f | wc -l)" \
  "$(($(stat -c %s "$file") / 1024))" "$holds"
