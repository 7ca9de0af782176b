#!/usr/bin/env bash
# setup.sh [--dry-run] GROUP...: installs the missing packages of these groups by apt, as root, or else with
# sudo after asking; with --dry-run prints the commands instead. Called by ./carlo setup and by each verb.
set -euo pipefail

# Packages by group. A package is not needed if its program (third column) is there, from whatever source.
# Embree is version 3 in Debian 12 and Ubuntu 22.04, otherwise 4: the build accepts both. labs/README.md lists
# the names of these packages on other systems.
package_table='
build     g++
build     cmake
build     ninja-build
build     ccache
build     libglm-dev
build     libfmt-dev
build     nlohmann-json3-dev
build     libpugixml-dev
build     libtbb-dev
build     libopenimageio-dev
build     libstb-dev
build     libembree-dev
build     libhwy-dev
build     libarchive-dev
build     nettle-dev
build     libboost-math-dev
build     zlib1g-dev
build     bubblewrap
build     libcatch2-dev
develop   git
develop   clang
develop   clang-format
develop   clang-tidy
develop   libclang-rt-dev
develop   llvm
develop   shellcheck
develop   python3-numpy
cluster   slurmctld
cluster   slurmd
cluster   slurm-client
cluster   munge
cluster   iproute2
peers     python3-venv
peers     libllvm19
node      nodejs              node
npm       npm                 npm
chromium  chromium            chromium
site      emscripten          emcc
zip       zip                 zip
'

fail() {
  printf 'carlo: %s\n' "$*" >&2
  exit 1
}

have() { command -v "$1" >/dev/null 2>&1; }

as_root() {
  local sudo=sudo
  [ "$(id -u)" != 0 ] || sudo=
  if [ -n "$dry_run" ]; then
    printf '%s\n' "${sudo:+sudo }$*"
  else
    # shellcheck disable=SC2086 # nothing, for root
    $sudo "$@" >/dev/null
  fi
}

# may_install PACKAGE...: succeeds for root, or if the user agrees at a terminal.
may_install() {
  local answer=n
  if [ "$(id -u)" = 0 ] || [ -n "$dry_run" ]; then return; fi
  if have sudo && [ -t 0 ] && [ -t 2 ]; then
    printf 'Carlo needs the Debian packages: %s\nInstall them with sudo? [Y/n] ' "$*" >&2
    read -r answer
  fi
  case $answer in
    n* | N*) fail "these Debian packages are missing: $* (as root: ./carlo setup)" ;;
  esac
}

# wanted_packages GROUP...: prints the packages of the groups, one per line, except those whose program is
# there.
wanted_packages() {
  local group package program
  while read -r group package program; do
    case " $* " in
      *" ${group:-none} "*) [ -n "$program" ] && have "$program" || printf '%s\n' "$package" ;;
    esac
  done <<<"$package_table"
}

# Prints those of these packages that are installed, with their versions. Called once for all packages,
# because each query reads the list of all packages on the machine.
installed_versions() {
  dpkg-query -W -f='${db:Status-Status} ${Package} ${Version}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true
}

# is_there PACKAGE VERSION: succeeds if the package is installed. Catch2 must be version 3: Debian 12 has it
# only in its backports; on Ubuntu 22.04, which has version 2, it may have been installed from source.
is_there() {
  if [ "$1" != libcatch2-dev ]; then
    [ -n "$2" ]
    return
  fi
  grep -q 'PACKAGE_VERSION "3' /usr/local/lib/cmake/Catch2/Catch2ConfigVersion.cmake 2>/dev/null ||
    { [ -n "$2" ] && dpkg --compare-versions "$2" ge 3; }
}

# missing_of PACKAGE...: prints those that are not installed, one per line.
missing_of() {
  local package there
  there=$'\n'$(installed_versions "$@")$'\n'
  for package in "$@"; do
    local version=${there##*$'\n'"$package "}
    [ "$version" != "$there" ] || version=
    is_there "$package" "${version%%$'\n'*}" || printf '%s\n' "$package"
  done
}

# Prints the mirror that this machine already uses.
debian_mirror() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    grep -E -m1 '/debian/?$') || true
  printf '%s' "${mirror:-http://deb.debian.org/debian}"
}

is_bookworm() { [ "$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")" = bookworm ]; }
has_backports() { apt-cache policy | grep -q 'n=bookworm-backports'; }

add_backports() {
  local line list=/etc/apt/sources.list.d/carlo-backports.list
  if ! is_bookworm || has_backports; then return; fi
  line="deb $(debian_mirror) bookworm-backports main"
  if [ -n "$dry_run" ]; then
    printf "printf '%%s\\\\n' '%s' | " "$line"
    as_root tee "$list"
  else
    printf '%s\n' "$line" | as_root tee "$list"
  fi
  as_root apt-get -qq update
}

# install WORD...: runs apt-get with these arguments.
install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends "$@"
}

install_catch2() {
  local version
  add_backports
  if has_backports || { [ -n "$dry_run" ] && is_bookworm; }; then
    install -t bookworm-backports install libcatch2-dev
  else
    install install libcatch2-dev
  fi
  version=$(installed_versions libcatch2-dev)
  case ${version#* } in
    [012].*) fail "Catch2 here is version ${version#* }, and Carlo needs 3: labs/README.md says how to install it" ;;
  esac
}

dry_run=
if [ "${1:-}" = --dry-run ]; then dry_run=1 && shift; fi
read -ra wanted <<<"$(wanted_packages "$@" | tr '\n' ' ')"
[ ${#wanted[@]} != 0 ] || exit 0
if ! have dpkg-query || ! have apt-get; then
  printf 'carlo: automatic set-up needs apt, which is not on this machine. Install these with your package manager (their names may differ): %s (Catch2: version 3)\n' "${wanted[*]}" >&2
  exit 2
fi
read -ra missing <<<"$(missing_of "${wanted[@]}" | tr '\n' ' ')"
[ ${#missing[@]} != 0 ] || exit 0
may_install "${missing[@]}"
[ -n "$dry_run" ] || printf 'carlo: installing %s Debian packages ...\n' ${#missing[@]} >&2
as_root apt-get -qq update
others=()
for package in "${missing[@]}"; do [ "$package" = libcatch2-dev ] || others+=("$package"); done
[ ${#others[@]} = 0 ] || install install "${others[@]}"
[ ${#others[@]} = ${#missing[@]} ] || install_catch2
