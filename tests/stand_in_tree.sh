# shellcheck shell=bash
# A tree in which ./carlo runs with programs that are stand-ins: each prints how it was called. To be sourced
# with SOURCE, the suite, and VERBS, the program carlo_verbs; it sets `scratch`, `tree` and `tools`.

# The preset of whoever runs the tests does not apply to this tree.
unset CARLO_PRESET
# shellcheck disable=SC2154
source=$1 verbs=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
tree=$scratch/tree tools=$scratch/tools
bash=$(command -v bash)

failed() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

finish() {
  printf '%d failures\n' "$failures"
  [ "$failures" = 0 ]
}

# program FILE TEXT: a script.
program() {
  printf '#!%s\n%s\n' "$bash" "$2" >"$1"
  chmod +x "$1"
}

# stand_in FILE: it says with what it was called.
stand_in() { program "$1" "printf '%s\n' \"${1##*/}\${*:+ }\$*\""; }

mkdir -p "$tree/common/support" "$tree/build/release/bin" "$tree/tests" "$tree/labs" "$tools"
cp "$source/carlo" "$tree/"
cp -R "$source/common/course" "$tree/common/"
for lab in "$source"/labs/*/lab.json; do
  lab=${lab%/lab.json}
  mkdir "$tree/labs/${lab##*/}"
  cp "$lab/lab.json" "$tree/labs/${lab##*/}/"
done
for folder in solutions slides; do [ ! -d "$source/$folder" ] || ln -s "$source/$folder" "$tree/"; done
for folder in "$source"/tests/*/; do ln -s "$folder" "$tree/tests/"; done
: >"$tree/build/release/build.ninja"
for name in carlo_course carlo_watch carlo_replay lab01 lab01_judge lab01_worker lab08_render; do
  stand_in "$tree/build/release/bin/$name"
done
cp "$verbs" "$tree/build/release/bin/carlo_verbs"
: >"$tree/build/release/.verbs"
program "$tools/ninja" ''
program "$tools/cmake" ''

# Package managers, whose every package is there.
program "$tools/dpkg-query" 'for word in "$@"; do case $word in -*) ;; *) echo "installed $word 3.1-1" ;; esac; done'
for name in apt-get apt-cache sudo; do program "$tools/$name" "printf '%s\n' \"$name \$*\" >>'$scratch/calls'"; done
program "$tools/dpkg" '[[ ${2%%.*} -ge 3 ]]'
# Pretends to be root, unless FAKE_ID is set.
program "$tools/id" 'echo "${FAKE_ID:-0}"'
: >"$scratch/calls"

carlo() { (cd "$scratch" && PATH=$tools:$PATH timeout 60 "$tree/carlo" "$@" </dev/null); }

# expect CODE PATTERN ARGUMENT...: what it prints has a line like that.
expect() {
  local wanted=$1 pattern=$2 code=0 text
  shift 2
  text=$(carlo "$@" 2>&1) || code=$?
  if [ "$code" != "$wanted" ] || ! grep -Eq -e "$pattern" <<<"$text"; then
    failed "./carlo $*: exit code $code, \"$text\""
  fi
}

# expect_error PATTERN ARGUMENT...: one line on stderr, exit code 1.
expect_error() {
  local pattern=$1 code=0 text
  shift
  text=$(carlo "$@" 2>&1 >/dev/null) || code=$?
  if [ "$code" != 1 ] || [ "$(wc -l <<<"$text")" != 1 ] || ! grep -Eq "$pattern" <<<"$text"; then
    failed "./carlo $*: exit code $code, \"$text\""
  fi
}
