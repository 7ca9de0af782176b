# shellcheck shell=bash
# Selects the files that leave the suite, and makes archives of them. Source it; ROOT is the suite's
# folder.
#
# A folder added to the suite does not leave it until its name is listed here.

# fail MESSAGE: prints a line and exits.
fail() {
  printf 'carlo: %s\n' "$*" >&2
  exit 1
}

# lab_names ROOT: the labs of the course in order.
lab_names() { (cd "$1/labs" && printf '%s\n' [0-9][0-9]_*/lab.json | sed 's,/lab.json,,'); }

# number_of LAB: 07_hemisphere -> 7
number_of() { printf '%d' "$((10#${1%%_*}))"; }

# missing_parts K: prints regular expressions for the parts of common/ that no lab up to K uses.
missing_parts() {
  awk -v last="$1" '$1 > last {print "^common/" $2}' <<'END'
2 image/
2 numeric/
2 course/viewer/
4 sampling/
8 geometry/
8 render/
8 scene/
8 scenes/
8 course/render/
99 course/slurm/
99 course/verbs/(bench|grade|npm|slides)\.cpp$
END
}

# student_patterns ROOT K: prints regular expressions for the paths that students of labs 1 to K
# get.
student_patterns() {
  local root=$1 last=$2 lab
  cat <<'END'
^(CMakeLists\.txt|CMakePresets\.json|LICENSE|carlo|\.clang-format|\.editorconfig|\.gitignore)$
^\.(vscode|devcontainer)/
^\.github/workflows/grade\.yml$
^common/
^labs/(CMakeLists\.txt|README\.md|glossary\.md)$
^tests/CMakeLists\.txt$
^tests/grader/(CMakeLists\.txt|README\.md|[a-z_]+\.cmake)$
^tests/grader/(judge|page|protocol|replay|worker)/
END
  while read -r lab; do
    [ "$(number_of "$lab")" -le "$last" ] || continue
    printf '^labs/%s/\n' "$lab"
    printf '^tests/%s/((checks|probes)[a-z_]*\\.cpp|[a-z_]+\\.h)$\n' "$lab"
  done < <(lab_names "$root")
}

# all_files ROOT: lists the suite's files, tracked or to be added.
all_files() {
  git -C "$1" ls-files --cached --others --exclude-standard |
    while read -r file; do [ ! -f "$1/$file" ] || printf '%s\n' "$file"; done
}

# released_solutions ROOT K: lists the exercise files of the solutions of labs before K. Other files
# beside them (benchmarks) are not solutions.
released_solutions() {
  local root=$1 last=$2 file rest
  while read -r file; do
    rest=${file#solutions/}
    [ "$(number_of "$rest")" -lt "$last" ] || continue
    [ ! -f "$root/labs/$rest" ] || printf '%s\n' "$file"
  done < <(all_files "$root" | grep -E '^solutions/[0-9]{2}_.*\.cpp$')
}

# student_files ROOT K: lists all of these, sorted.
student_files() {
  {
    all_files "$1" | grep -E -f <(student_patterns "$1" "$2") | grep -Ev -f <(missing_parts "$2")
    released_solutions "$1" "$2"
  } | LC_ALL=C sort
}

# committed_tree ROOT DIRTY: fails unless everything that would leave is committed.
committed_tree() {
  git -C "$1" rev-parse --verify -q HEAD >/dev/null 2>&1 ||
    fail "archives are made from the suite's git repository, and this is none"
  [ -n "$2" ] || [ -z "$(git -C "$1" status --porcelain)" ] ||
    fail "there are uncommitted changes: commit them, or say --dirty to give them away too"
}

# check_output FILE: the archive's name determines its kind.
check_output() {
  case $1 in
    *.tar.gz | *.tgz | *.zip) ;;
    *) fail "an archive is a .tar.gz or a .zip, got '$1'" ;;
  esac
}

# lab_number ROOT TEXT COMPLAINT: prints 7 for 07; fails with the complaint if there is no text.
lab_number() {
  [ -n "$2" ] || fail "$3"
  [[ $2 =~ ^[0-9]{1,2}$ ]] || fail "a lab is a number such as 1, got '$2'"
  local number=$((10#$2))
  [[ " $(lab_names "$1" | tr '\n' ' ')" == *" $(printf '%02d' "$number")_"* ]] ||
    fail "there is no lab $2"
  printf '%d' "$number"
}

# plain_rights FOLDER: sets the same permissions, whoever makes the archive.
plain_rights() { chmod -R u=rwX,go=rX "$1"; }

# need_for ROOT FILE: installs the programs that pack such a file, once the arguments have been
# checked.
need_for() {
  case $2 in *.zip) "$1/common/course/setup.sh" zip || exit 1 ;; esac
}

# pack FOLDER FILE SECONDS: archives FOLDER's content so that the bytes depend only on that content
# and on SECONDS, the time of all files: sorted, owner 0.
pack() {
  local folder=$1 file=$2 seconds=$3 new
  mkdir -p "$(dirname "$file")" || fail "cannot write $file"
  file=$(readlink -f "$(dirname "$file")")/$(basename "$file")
  new=$(mktemp -d "$(dirname "$file")/.archive.XXXXXX")
  case $file in
    *.zip)
      find "$folder" -exec touch -h -d "@$seconds" {} +
      (cd "$folder" && find . -type f -printf '%P\n' | LC_ALL=C sort |
        TZ=UTC zip -X -q "$new/archive.zip" -@) || fail "zip failed"
      mv "$new/archive.zip" "$file" ;;
    *)
      (cd "$folder" && find . -type f -printf '%P\n' | LC_ALL=C sort |
        tar --create --no-recursion --mtime="@$seconds" --owner=0 --group=0 --numeric-owner \
          --format=ustar --files-from=-) | gzip -9n >"$new/archive" || fail "tar failed"
      mv "$new/archive" "$file" ;;
  esac
  rmdir "$new"
}
