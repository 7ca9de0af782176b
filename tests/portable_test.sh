#!/usr/bin/env bash
# portable_test.sh SOURCE: what students run works under bash 3.2 and the tools of macOS, as far as
# Linux can show. ./carlo and the scripts that it sources or starts have none of the constructs of
# tests/portable.txt (each of which must match its own sample); its verbs run with tools restricted
# to POSIX that refuse what BSD's refuse; set-up runs the right commands for each package manager,
# all faked.
set -euo pipefail
# From whoever runs the tests; the trees here have their own.
unset CARLO_PRESET
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

failed() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

# --- the lint ------------------------------------------------------------------------------------

# code FILE: prints its lines with numbers, without comments and here-document text.
code() {
  awk '
    ending != "" {if ($0 == ending) ending = ""; next}
    /<<'"'"'[A-Z]+'"'"'/ {ending = $0; sub(/^.*<<'"'"'/, "", ending); sub(/'"'"'.*$/, "", ending)}
    !/^ *#/ {print FILENAME ":" FNR ": " $0}' "$1"
}

# slips CODE: prints lines of that file with a forbidden construct, and the reason. A line that
# checks whether a tool exists, or has an alternative, may name one that is missing elsewhere.
slips() {
  local reason sample pattern found
  while IFS=$'\037' read -r reason sample pattern; do
    found=$(grep -E -e "$pattern" "$1" || true)
    case $reason in absent*) found=$(grep -Ev 'command -v|2>/dev/null \|\||\] \|\| ' <<<"$found" || true) ;; esac
    [ -z "$found" ] || printf '%s\n    %s\n' "$found" "$reason"
  done <"$scratch/rules"
}

# A rule is three lines: the reason, a sample, the extended regular expression; CMD begins a
# command.
awk -v cmd='((^|[;\\&|({:]) *|[ (](then|do|else|if|while|exec|env|xargs|!) +)' '
  /^#/ || NF == 0 {next}
  {line[++n] = $0}
  n == 3 {gsub(/CMD/, cmd, line[3]); sub(/^ +/, "", line[2]); sub(/^ +/, "", line[3])
          print line[1] "\037" line[2] "\037" line[3]; n = 0}
' "$source/tests/portable.txt" >"$scratch/rules"
[ "$(wc -l <"$scratch/rules")" -gt 30 ] || failed "few rules"

# Each rule must catch its sample: a rule that catches nothing proves nothing.
while IFS=$'\037' read -r reason sample pattern; do
  grep -Eq -e "$pattern" <<<"$sample" || failed "the rule against \"$reason\" does not see: $sample"
done <"$scratch/rules"
# Reports give place and reason; correct code is not reported.
printf '%s\n' '# readlink -f' 'cat <<'\''EOF'\''' 'realpath .' 'EOF' 'timeout 5 cat' >"$scratch/bad.sh"
code "$scratch/bad.sh" >"$scratch/code"
[ "$(slips "$scratch/code")" = "$scratch/bad.sh:5: timeout 5 cat"$'\n    absent: BSD has no such tool' ] ||
  failed "of bad code is told: $(slips "$scratch/code")"
cat >"$scratch/good.sh" <<'EOF'
for word in ${words[@]+"${words[@]}"}; do echo "${words[*]-}" | sed -n 's/^\([a-z][a-z]*\)$/\1/p'; done
command -v flock >/dev/null && flock 9
if [[ $text =~ ^[0-9]{1,2}$ ]]; then grep -Eo 'a+|b?' "$file" || true; fi
echo "${line:1} ${text//,/ } $(dirname "$path")" # readlink -f
EOF
code "$scratch/good.sh" >"$scratch/code"
[ -z "$(slips "$scratch/code")" ] || failed "good code is told: $(slips "$scratch/code")"

for script in "$source/carlo" "$source"/common/*/*.sh; do code "$script"; done >"$scratch/code"
found=$(slips "$scratch/code")
[ -z "$found" ] || failed "not for every machine:"$'\n'"$found"

# --- tools that refuse what BSD's do -------------------------------------------------------------

tools=$scratch/tools
mkdir "$tools"
bash=$(command -v bash)
for tool in bash env cat awk dirname basename tr cksum mkdir id tee sleep perl getconf wc ls mv ln chmod uname touch; do
  ! command -v "$tool" >/dev/null || ln -s "$(command -v "$tool")" "$tools/$tool"
done

# refusing TOOL REFUSED [REQUIRED]: makes a version of the tool that fails, and records the call, if
# an argument matches REFUSED, or if the call does not match REQUIRED.
refusing() {
  cat >"$tools/$1" <<EOF
#!$bash
for word in "\$@"; do
  if [[ \$word =~ ^($2)\$ ]]; then
    printf '%s\n' "$1 \$*" >>'$scratch/slips'
    echo "$1: illegal option -- \$word" >&2
    exit 64
  fi
done
exec '$(command -v "$1")' "\$@"
EOF
  chmod +x "$tools/$1"
}
refusing readlink '-[a-zA-Z]*[fem].*|--.+'
refusing sed '-[a-z]*i.*|-[zsu]|--.+|[^-].*\\[+?|].*'
refusing grep '-[a-zA-Z]*[PzT].*|--.+'
refusing date '-d.*|-I.*|--.+|.*%[0-9]*N.*'
refusing stat '-c.*|--.+'
refusing xargs '-r|-d.*|--.+'
refusing mktemp '-p.*|--.+'
refusing sort '-[a-zA-Z]*[VhRz].*|--.+'
refusing head '-[0-9]+|-n-.*|--.+'
refusing find '-(printf|readable|writable|executable|xtype|regextype|quit)'
refusing cp '-[a-zA-Z]*[tTu].*|--.+'
refusing rm '--.+'
for tool in sed stat; do ! "$tools/$tool" --version >/dev/null 2>&1 || failed "the stand-in for $tool refuses nothing"; done
"$tools/readlink" -f / >/dev/null 2>&1 && failed "the stand-in for readlink refuses nothing"
: >"$scratch/slips"

# --- a tree whose programs are stand-ins ---------------------------------------------------------

tree=$scratch/tree
mkdir -p "$tree/common" "$tree/build/release/bin"
cp "$source/carlo" "$tree/"
cp -R "$source/common/course" "$tree/common/"
for lab in "$source"/labs/*/lab.json; do
  lab=${lab%/lab.json}
  mkdir -p "$tree/labs/${lab##*/}"
  cp "$lab/lab.json" "$tree/labs/${lab##*/}/"
done
cp "$source/labs/CMakeLists.txt" "$tree/labs/"
: >"$tree/build/release/build.ninja"

# stand_in FILE: makes a program that prints its arguments; ./carlo's own descriptors are closed to
# it.
stand_in() {
  cat >"$1" <<EOF
#!$bash
printf '%s\n' "${2-${1##*/}}\${*:+ }\$*"
EOF
  chmod +x "$1"
}
for program in carlo_course carlo_keep carlo_watch carlo_replay lab01 lab01_judge lab01_worker lab08_render; do
  stand_in "$tree/build/release/bin/$program"
done
# The judge only writes its questions.
cat >"$tree/build/release/bin/lab01_judge" <<EOF
#!$bash
printf '%s\n' "lab01_judge \$*"
while [ \$# != 0 ]; do [ "\$1" != --probes ] || : >"\$2"; shift; done
EOF
for program in ninja cmake; do stand_in "$tools/$program" ''; done

# carlo ARGUMENT...: runs ./carlo with only these tools, by the rules of bash 3.2 that a newer one
# knows.
carlo() { (cd "$scratch" && PATH=${managers:+$managers:}$tools BASH_COMPAT=3.2 "$bash" "$tree/carlo" "$@" </dev/null); }

# expect CODE PATTERN ARGUMENT...: the output has a matching line.
expect() {
  local wanted=$1 pattern=$2 code=0 text
  shift 2
  text=$(carlo "$@" 2>&1) || code=$?
  if [ "$code" != "$wanted" ] || ! grep -Eq -e "$pattern" <<<"$text"; then
    failed "./carlo $*: exit code $code, \"$text\""
  fi
}

# --- package managers ----------------------------------------------------------------------------

# manager NAME: makes a folder of fakes that record their calls in $scratch/calls.
manager() {
  local name=$1
  shift
  mkdir -p "$scratch/$name"
  for program in "$name" "$@"; do
    cat >"$scratch/$name/$program" <<EOF
#!$bash
printf '%s\n' "$program \$*" >>'$scratch/calls'
EOF
    chmod +x "$scratch/$name/$program"
  done
  # As root, whoever runs this.
  printf '#!%s\necho "${FAKE_ID:-0}"\n' "$bash" >"$scratch/$name/id"
  chmod +x "$scratch/$name/id"
  managers=$scratch/$name
}

# called PATTERN: a matching call was recorded; clears the record.
called() {
  grep -Eq -e "$1" "$scratch/calls" || failed "with ${managers##*/} nobody called $1 but: $(cat "$scratch/calls")"
  : >"$scratch/calls"
}

managers=
expect 1 'knows apt, dnf, pacman and brew, and none is here; install: g\+\+ cmake .* and Catch2 version 3' setup
expect 1 'knows apt, dnf' setup --dry-run
expect 0 '^carlo_course status --root .*tree$' status

manager dnf rpm
cat >"$managers/rpm" <<EOF
#!$bash
for word in "\$@"; do case \$word in -* | cmake) ;; *) echo "no package provides \$word" ;; esac; done
exit 1
EOF
: >"$scratch/calls"
names='gcc-c\+\+ ninja-build .*stb_image_write-devel .*zlib-devel bubblewrap catch-devel'
expect 0 "^dnf -q -y .* install $names\$" setup --dry-run
[ ! -s "$scratch/calls" ] || failed "--dry-run called dnf"
FAKE_ID=1000 expect 0 '^sudo dnf' setup --dry-run
FAKE_ID=1000 expect 1 "these Fedora packages are missing: $names \(as root: ./carlo setup\)" status
expect 0 'everything is installed' setup
called "^dnf -q -y --setopt=install_weak_deps=False install $names\$"
expect 0 ' ShellCheck .*nodejs npm chromium' setup --developer --dry-run
printf '#!%s\n' "$bash" >"$managers/rpm"
expect 0 '^carlo: everything is installed$' setup --dry-run

manager pacman
cat >"$managers/pacman" <<EOF
#!$bash
if [ "\$1" = -T ]; then shift; printf '%s\n' "\$@"; exit 127; fi
printf '%s\n' "pacman \$*" >>'$scratch/calls'
EOF
names='gcc cmake ninja .*onetbb .*stb embree highway .*catch2'
expect 0 "^pacman -S --needed --noconfirm $names\$" setup --dry-run
expect 0 'everything is installed' setup
called "^pacman -S --needed --noconfirm $names\$"
expect 1 'debugger is not installed; as root: pacman -S gdb' replay 1.2 --probe 1 --gdb

manager brew
cat >"$managers/brew" <<EOF
#!$bash
if [ "\$1" = --prefix ]; then echo '$scratch/brewed'; exit; fi
printf '%s\n' "brew \$*" >>'$scratch/calls'
EOF
mkdir -p "$scratch/brewed/opt/cmake"
expect 0 '^brew install ninja ccache glm fmt .*embree highway .*boost catch2$' setup --dry-run
expect 0 '^curl .*stb_image_write.h' setup --dry-run
expect 1 'these are missing: ninja' status
expect 1 'Homebrew has no stb_image_write.h; put it there' setup
called '^brew install -q ninja .*catch2$'
mkdir -p "$scratch/brewed/include/stb"
: >"$scratch/brewed/include/stb/stb_image_write.h"
expect 0 'everything is installed' setup

manager apt-get apt-cache dpkg dpkg-query tee
if [ -e /etc/debian_version ]; then
  printf '#!%s\nexit 1\n' "$bash" >"$managers/dpkg"
  names='g\+\+ cmake .* bubblewrap'
  : >"$scratch/calls"
  expect 0 "^env .* install $names\$" setup --dry-run
  expect 0 'installing 20 Debian packages' setup
  called "^apt-get -qq -y --no-install-recommends install $names\$"
  FAKE_ID=1000 expect 1 "^carlo: these Debian packages are missing: $names libcatch2-dev \(as root: ./carlo setup\)\$" status
  cat >"$managers/dpkg-query" <<'EOF'
for word in "$@"; do case $word in -*) ;; *) echo "installed $word 2.13.8-1" ;; esac; done
EOF
  sed "1s,^,#!$bash\n," "$managers/dpkg-query" >"$scratch/new" && cat "$scratch/new" >"$managers/dpkg-query"
  [ -e /usr/local/lib/cmake/Catch2 ] || expect 1 'Catch2 here is version 2.13.8-1, and Carlo needs 3' setup
fi

# --- the verbs -----------------------------------------------------------------------------------

# All packages are there.
manager pacman
expect 0 'usage: ./carlo VERB' --help
expect 0 'setup .* install what is missing' help
expect 1 'did you mean ./carlo test\?' tset
expect 1 'did you mean ./carlo status\?' STATSU
expect 1 'no lab 99; there are: 1, 2' lab 99
expect 1 'no exercise 1.99; lab 1 has 1.1 to' hint 1.99
expect 1 'takes --developer and --dry-run only' setup --frob
expect 1 'takes one lab' watch 1 2
expect 0 '^carlo_course status --root .*tree --json$' status --json
expect 0 '^carlo_course hint --root .*tree 1.2$' hint 1.2
expect 0 '^lab01$' lab 1
expect 0 '^lab01 --quick$' lab 1 --quick
expect 0 '^lab01_judge --lab .*lab.json --worker .*--failure-page out/test01.html$' test 1
expect 0 '^lab01_judge .* --exercise 1.3$' test 1.2 1.3
expect 0 '^lab01_judge .* --seed 7 .*--exercise 1.2$' test 1.2 --seed 7
expect 0 '^carlo_watch --root .* 1$' watch 1
expect 0 '^carlo_replay 1.2 --lab .*lab01_worker$' replay 1.2
expect 0 '^lab08_render --default-scene .*cornell_phong.xml$' render

# Through a link from another folder, and a link to that link.
mkdir "$scratch/links"
ln -s ../tree/carlo "$scratch/links/first"
ln -s "$scratch/links/first" "$scratch/second"
(cd / && PATH=$managers:$tools "$bash" "$scratch/second" status) | grep -q "^carlo_course status --root $(cd "$tree" && pwd -P)\$" ||
  failed "through links"

# Leftovers of killed runs are removed, and nobody else's.
mkdir -p "$tree/build/release/run/999999999" "$tree/build/release/run/$$"
touch -t 202001010000 "$tree/build/release/run/999999999" "$tree/build/release/run/$$"
expect 0 '^lab01$' lab 1
[ ! -e "$tree/build/release/run/999999999" ] || failed "a killed run's folder stays"
[ -e "$tree/build/release/run/$$" ] || failed "the folder of a run that lives was removed"

# Users are told of a long wait.
cat >"$tools/ninja" <<EOF
#!$bash
case " \$* " in *' -n '*) for step in {1..21}; do printf '[%d] c++\n' "\$step"; done ;; esac
EOF
expect 0 'building .a minute or more' lab 1
stand_in "$tools/ninja" ''
carlo lab 1 2>&1 | grep -q building && failed "a build of no steps is told as a long one"

# Turns without flock.
if [ -x "$tools/perl" ]; then
  turn() { PATH=$tools "$bash" "$tree/common/course/in_turn.sh" "$tree/build/release" "$@"; }
  CARLO_TURN_OF='the first' turn "$bash" -c 'touch "$1" && sleep .5 && rm "$1"' - "$scratch/held" &
  for _ in {1..3000}; do [ -e "$scratch/held" ] || sleep .02; done
  turn "$bash" -c '[ ! -e "$1" ]' - "$scratch/held" 3>"$scratch/told" || failed "two at once without flock"
  grep -q 'waiting for the first' "$scratch/told" || failed "nobody was told of the first"
  wait
fi

[ ! -s "$scratch/slips" ] || failed "calls that BSD's tools refuse: $(cat "$scratch/slips")"
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
