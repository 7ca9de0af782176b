#!/usr/bin/env bash
# Makes the zip with which Gradescope grades a lab; ./carlo gradescope. See usage.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../../..")

usage() {
  cat <<'END'
usage: ./carlo gradescope N [-o FILE.zip] [--secret-file FILE] [--dirty]

Writes the autograder of lab N for Gradescope (default out/gradescope_labN.zip): upload it as the
assignment's autograder. It holds the students' tree of labs 1 to N, so the solutions of earlier labs,
and the grader; of lab N the solution only if exercises build on one another, so that a mistake in
one costs no points in the next; no references, no mistakes.

  --secret-file FILE   random numbers follow from this file's text; without it a new secret is made,
                       printed, and kept in the zip alone
  --dirty              take uncommitted changes too
END
}

. "$here/tree.sh"

lab='' file='' secret_file='' dirty=''
while [ $# != 0 ]; do
  case $1 in
    --help | -h) usage && exit ;;
    --dirty) dirty=yes ;;
    --secret-file | -o | --output)
      [ $# -gt 1 ] || fail "$1 needs a value (see ./carlo gradescope --help)"
      if [ "$1" = --secret-file ]; then secret_file=$2; else file=$2; fi
      shift ;;
    -*) fail "gradescope does not know '$1' (see ./carlo gradescope --help)" ;;
    *)
      [ -z "$lab" ] || fail "an autograder is for one lab, got $lab and $1"
      lab=$1 ;;
  esac
  shift
done
lab=$(lab_number "$root" "$lab" "gradescope needs a lab, such as 3")
file=${file:-$root/out/gradescope_lab$lab.zip}
[[ $file == *.zip ]] || fail "Gradescope takes a .zip, got '$file'"
[ -z "$secret_file" ] || [ -s "$secret_file" ] || fail "$secret_file: no such file, or it is empty"
[ -d "$root/tests/grader/grade" ] || fail "this tree cannot grade classes: tests/grader/grade is missing"
committed_tree "$root" "$dirty"
need_for "$root" "$file"

umask 077
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/carlo"
{
  student_files "$root" "$lab"
  all_files "$root" | grep -E '^(tests/grader/grade|common/course/slurm)/|^common/course/verbs/(grade|npm)\.cpp$'
  if grep -q '"uses"' "$root"/labs/"$(printf '%02d' "$lab")"_*/lab.json; then
    released_solutions "$root" "$((lab + 1))" | grep "^solutions/$(printf '%02d' "$lab")_"
  fi
} | tar -C "$root" -c --files-from=- | tar -C "$scratch/carlo" -x
cp "$here/gradescope/setup.sh" "$here/gradescope/run_autograder" "$scratch/"
printf '%s\n' "$lab" >"$scratch/lab"
# For images that are not Debian's; every Debian has it.
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
[ ! -f "$keyring" ] || cp "$keyring" "$scratch/"
plain_rights "$scratch"
if [ -n "$secret_file" ]; then
  cp "$secret_file" "$scratch/secret"
else
  head -c 24 /dev/urandom | base64 >"$scratch/secret"
fi
chmod 600 "$scratch/secret"
pack "$scratch" "$file" "$(git -C "$root" log -1 --format=%ct)"
chmod 600 "$file"
printf 'carlo: wrote %s (%s KB): the autograder of lab %s\n' "$file" \
  "$(($(stat -c %s "$file") / 1024))" "$lab"
[ -n "$secret_file" ] ||
  printf 'carlo: its secret, for grading the same numbers elsewhere: %s\n' "$(cat "$scratch/secret")"
