#!/usr/bin/env bash
# chroot.sh [MACHINE ...] [--store FOLDER] [--fresh] [--step STEP ...] [-- ARGUMENT...]
# Runs the README's commands on other machines, as root, on a clean clone of HEAD. A MACHINE is
#
#   bookworm, trixie  a bare Debian 12 or 13 (the default: both), or any other release by its name
#   aarch64           a Debian 13 that compiles for 64-bit ARM; QEMU runs the programs (needs
#                     qemu-user-static here): all fast tests
#   libcxx            a Debian 13 with clang and LLVM's standard library, as on macOS: all fast tests
#
# debootstrap makes each machine once. FOLDER (build/machines) keeps it with the packages that set-up has
# installed and with the build, so that the next run continues there and builds only what has changed.
#
#   --fresh      starts without packages and builds (keeps the base system)
#   --step STEP  runs only these steps of setup (./carlo setup, or its counterpart there), render
#                (./carlo render) and test (./carlo test --solutions); or shell: opens a shell in the tree
#   ARGUMENT     for ctest, such as -R common, instead of -L fast
#
# Each step prints when it began; the last lines say what passed and how long it took; the output of a step
# is in FOLDER/MACHINE.STEP.log. Exit code 0: all passed.
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
. "$root/tests/machines/inside.sh"

machines=() steps=() store=$root/build/machines fresh='' ctest=()
while [ $# != 0 ]; do
  case $1 in
    --help | -h) sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}" && exit ;;
    --store) store=${2:?--store needs a folder} && shift ;;
    --fresh) fresh=yes ;;
    --step)
      case ${2:-} in
        setup | render | test | shell) steps+=("$2") ;;
        *) fail "--step is setup, render, test or shell, got '${2:-}'" ;;
      esac
      shift ;;
    --) shift && ctest=("$@") && break ;;
    -*) fail "knows no '$1' (see --help)" ;;
    *) machines+=("$1") ;;
  esac
  shift
done
[ ${#machines[@]} != 0 ] || machines=(bookworm trixie)
[ ${#steps[@]} != 0 ] || steps=(setup render test)
needs_root_and debootstrap unshare pivot_root git
mkdir -p "$store"
store=$(readlink -f "$store")

# The differences between machines: Debian's release, the preset, set-up, which tests.
suite_of() { case $1 in aarch64 | libcxx) printf trixie ;; *) printf '%s' "$1" ;; esac; }
preset_of() { case $1 in aarch64 | libcxx) printf '%s' "$1" ;; *) printf release ;; esac; }
setup_of() { case $1 in aarch64 | libcxx) printf 'tests/machines/%s.sh' "$1" ;; *) printf './carlo setup' ;; esac; }
tests_of() { case $1 in aarch64 | libcxx) printf -- '-L fast' ;; esac; }

summary='' failed=0
# step MACHINE NAME COMMAND...: runs it there, and keeps its output.
step() {
  local machine=$1 name=$2 log=$store/$1.$2.log begun=$SECONDS word=passed
  shift 2
  printf '\n=== %s: %s, %s\n' "$machine" "$*" "$(date +%H:%M:%S)"
  CARLO_PRESET=$(preset_of "$machine") inside "$store/$machine" "$@" 2>&1 | tee "$log" || word=FAILED failed=1
  summary+=$(printf '%-10s %-7s %s in %d s' "$machine" "$name" "$word" "$((SECONDS - begun))")$'\n'
  [ "$word" = passed ]
}

# tests MACHINE ARGUMENT...
tests() {
  local machine=$1 arguments=("${@:2}")
  [ ${#arguments[@]} != 0 ] || read -ra arguments <<<"$(tests_of "$machine")"
  step "$machine" test ./carlo test --solutions ${arguments[@]+"${arguments[@]}"}
}

for machine in "${machines[@]}"; do
  exec 8>"$store/$machine.lock"
  flock -n 8 || fail "another run is at work in $store/$machine"
  base_system "$(suite_of "$machine")" "$store/$machine" "$fresh"
  clean_clone "$root" "$store/$machine/carlo"
  preset=$(preset_of "$machine")
  # An older preset may have configured it.
  [ ! -f "$store/$machine/carlo/build/$preset/build.ninja" ] || inside "$store/$machine" cmake --preset "$preset" >/dev/null
  for name in "${steps[@]}"; do
    case $name in
      # Without set-up nothing else can work; a failed render says nothing about the tests.
      setup)
        read -ra command <<<"$(setup_of "$machine")"
        step "$machine" setup "${command[@]}" || break ;;
      render) step "$machine" render ./carlo render --size 64x64 --spp 16 -o /tmp/render || true ;;
      test) tests "$machine" ${ctest[@]+"${ctest[@]}"} || true ;;
      shell) CARLO_PRESET=$(preset_of "$machine") inside "$store/$machine" bash || true ;;
    esac
  done
done
printf '\n%s' "$summary"
exit "$failed"
