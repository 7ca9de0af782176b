# shellcheck shell=bash
# The packages that Carlo needs, and the package manager that installs them. Sourced by ./carlo; needs
# only bash 3.2 and the tools of macOS (tests/portable_test.sh).

# Packages are called by Debian's names. "=": part of the system, or not needed there; "!": not available
# there. Fedora's names are those of its spec files, Arch's and Homebrew's those of their package
# files. Embree is version 3 in Debian 12 and Ubuntu 22.04, else 4: the build takes both. Fedora calls
# version 3 of Catch2 "catch" (2 is "catch2"), Arch has TBB as "onetbb", and Embree for x86-64 only.
#
# for    Debian                Fedora                 Arch           Homebrew
package_table='
build    g++                   gcc-c++                gcc            =
build    cmake                 cmake                  cmake          cmake
build    ninja-build           ninja-build            ninja          ninja
build    ccache                ccache                 ccache         ccache
build    patch                 patch                  patch          =
build    libglm-dev            glm-devel              glm            glm
build    libfmt-dev            fmt-devel              fmt            fmt
build    nlohmann-json3-dev    json-devel             nlohmann-json  nlohmann-json
build    libpugixml-dev        pugixml-devel          pugixml        pugixml
build    libtbb-dev            tbb-devel              onetbb         tbb
build    libopenimageio-dev    OpenImageIO-devel      openimageio    openimageio
build    libstb-dev            stb_image_write-devel  stb            !
build    libembree-dev         embree-devel           embree         embree
build    libhwy-dev            highway-devel          highway        highway
build    libarchive-dev        libarchive-devel       libarchive     libarchive
build    nettle-dev            nettle-devel           nettle         nettle
build    libboost-math-dev     boost-devel            boost          boost
build    zlib1g-dev            zlib-devel             zlib           =
build    bubblewrap            bubblewrap             bubblewrap     !
catch2   libcatch2-dev         catch-devel            catch2         catch2
develop  git                   git                    git            =
develop  clang                 clang                  clang          llvm
develop  clang-format          clang-tools-extra      clang          clang-format
develop  clang-tidy            clang-tools-extra      clang          llvm
develop  libclang-rt-dev       compiler-rt            compiler-rt    llvm
develop  llvm                  llvm                   llvm           llvm
develop  shellcheck            ShellCheck             shellcheck     shellcheck
cluster  slurmctld             slurm-slurmctld        !              !
cluster  slurmd                slurm-slurmd           !              !
cluster  slurm-client          slurm                  !              !
cluster  munge                 munge                  !              !
cluster  iproute2              iproute                iproute2       !
browser  nodejs                nodejs                 nodejs         node
browser  npm                   npm                    npm            node
browser  chromium              chromium               chromium       !
peers    python3-venv          python3                python         python
peers    libllvm19             llvm-libs              llvm-libs      llvm
other    zip                   zip                    zip            =
'

# Set by ./carlo setup --dry-run: print commands instead of running them.
dry_run=

have() { command -v "$1" >/dev/null 2>&1; }

# Prints apt, dnf, pacman or brew, whichever is here; nothing if none is. Some systems package
# another system's tools, so Debian is also identified by a file.
package_manager() {
  if have dpkg-query && { [ -e /etc/debian_version ] || ! { have rpm || have pacman || have brew; }; }; then
    printf apt
  elif have dnf && have rpm; then printf dnf
  elif have pacman; then printf pacman
  elif have brew; then printf brew
  fi
}

# packages_for GROUP: prints Debian's names of that group, in one line.
packages_for() { printf '%s' "$package_table" | awk -v group="$1" '$1 == group {printf "%s ", $2}'; }

# names_on MANAGER PACKAGE...: prints the packages' names there, in one line, each once. A package
# that is not in the table keeps its name.
names_on() {
  local manager=$1
  shift
  { printf '%s' "$package_table" && printf 'wanted %s\n' "$@"; } |
    awk -v manager="$manager" '
      BEGIN {column["apt"] = 2; column["dnf"] = 3; column["pacman"] = 4; column["brew"] = 5}
      $1 != "wanted" {name[$2] = $column[manager]; next}
      {there = ($2 in name) ? name[$2] : $2}
      there != "=" && there != "!" && !seen[there]++ {printf "%s ", there}'
}

as_root() {
  local sudo=sudo
  [ "$(id -u)" != 0 ] || sudo=
  if [ -n "$dry_run" ]; then
    printf '%s\n' "${sudo:+sudo }$*"
  else
    # shellcheck disable=SC2086 # empty for root
    $sudo "$@" >/dev/null
  fi
}

# may_install WHAT HOW PACKAGE...: succeeds for root, or if the user agrees at a terminal.
may_install() {
  local what=$1 how=$2 answer=n
  shift 2
  [ "$(id -u)" != 0 ] && [ -z "$dry_run" ] || return 0
  if have sudo && [ -t 0 ] && [ -t 2 ]; then
    printf 'Carlo needs the %s: %s\nInstall them with sudo? [Y/n] ' "$what" "$*" >&2
    read -r answer
  fi
  case $answer in
    n* | N*) fail "these $what are missing: $* ($how)" ;;
  esac
}

# packages_of PACKAGE:PROGRAM ...: prints the packages of those programs that are missing.
packages_of() {
  local entry
  for entry in "$@"; do
    command -v "${entry#*:}" >/dev/null || printf '%s ' "${entry%%:*}"
  done
}

# need_programs PACKAGE:PROGRAM ...: installs those that are missing.
need_programs() {
  local missing
  read -ra missing <<<"$(packages_of "$@")"
  [ ${#missing[@]} = 0 ] || setup ${missing[@]+"${missing[@]}"}
  [ -z "$(packages_of "$@")" ] || fail "this machine's packages do not have: $(packages_of "$@")"
}

# Prints, in words, what set-up leaves to the user.
how_to_install() {
  case $(package_manager) in
    dnf) printf 'as root: dnf install %s' "$1" ;;
    pacman) printf 'as root: pacman -S %s' "$1" ;;
    brew) printf 'where Homebrew has it: brew install %s' "$1" ;;
    *) printf 'as root: apt-get install %s' "$1" ;;
  esac
}

# setup [PACKAGE ...]: installs what is missing of the build's packages and these.
setup() {
  local manager packages
  manager=$(package_manager)
  read -ra packages <<<"$(packages_for build)"
  packages+=("$@")
  case $manager in
    apt) setup_by_apt ${packages[@]+"${packages[@]}"} ;;
    dnf | pacman | brew)
      read -ra packages <<<"$(names_on "$manager" ${packages[@]+"${packages[@]}"} libcatch2-dev)"
      "setup_by_$manager" ${packages[@]+"${packages[@]}"} ;;
    *) setup_by_hand ${packages[@]+"${packages[@]}"} ;;
  esac
}

# setup_group GROUP: the build's packages and those of that group.
setup_group() {
  local packages
  read -ra packages <<<"$(packages_for "$1")"
  setup ${packages[@]+"${packages[@]}"}
}

# Whoever has installed everything by hand can go on working.
setup_by_hand() {
  local what="set-up knows apt, dnf, pacman and brew, and none is here; install: $* and Catch2 version 3"
  # shellcheck disable=SC2154 # set by ./carlo, as is build
  [ "$verb" != setup ] || fail "$what"
  # shellcheck disable=SC2154
  [ -f "$build/build.ninja" ] || printf 'carlo: %s\n' "$what" >&2
}

# --- Debian and Ubuntu ---------------------------------------------------------------------------

# Prints package and version of each of these that is installed. Asks once for all, since each query
# reads the list of everything on the machine.
installed_versions() {
  dpkg-query -W -f='${db:Status-Status} ${Package} ${Version}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true
}

# Catch2 must be version 3: Debian 12 has it in its backports only.
is_catch2_version() { [ -n "$1" ] && dpkg --compare-versions "$1" ge 3; }

# Ubuntu 22.04 has version 2 only; version 3 may have been installed there from source.
has_own_catch2() {
  grep -q 'PACKAGE_VERSION "3' /usr/local/lib/cmake/Catch2/Catch2ConfigVersion.cmake 2>/dev/null
}

# The mirror that this machine already uses.
debian_mirror() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    grep -E -m1 '/debian/?$') || true
  printf '%s' "${mirror:-http://deb.debian.org/debian}"
}

is_bookworm() { [ "$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")" = bookworm ]; }

add_backports() {
  local line list=/etc/apt/sources.list.d/carlo-backports.list
  is_bookworm || return 0
  apt-cache policy | grep -q 'n=bookworm-backports' && return 0
  line="deb $(debian_mirror) bookworm-backports main"
  if [ -n "$dry_run" ]; then
    printf "printf '%%s\\\\n' '%s' | " "$line"
    as_root tee "$list"
  else
    printf '%s\n' "$line" | as_root tee "$list"
  fi
  as_root apt-get -qq update
}

install_catch2() {
  local release=()
  if apt-cache policy | grep -q 'n=bookworm-backports' || { [ -n "$dry_run" ] && is_bookworm; }; then
    release=(-t bookworm-backports)
  fi
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends \
    ${release[@]+"${release[@]}"} install libcatch2-dev
}

setup_by_apt() {
  local missing=() package there
  there=$'\n'$(installed_versions "$@" libcatch2-dev)$'\n'
  for package in "$@"; do
    [[ $there = *$'\n'"$package "* ]] || missing+=("$package")
  done
  local catch2=${there##*$'\n'libcatch2-dev }
  [ "$catch2" != "$there" ] || catch2=
  catch2=${catch2%%$'\n'*}
  ! has_own_catch2 || catch2=3
  if [ ${#missing[@]} = 0 ] && is_catch2_version "$catch2"; then return; fi
  may_install 'Debian packages' 'as root: ./carlo setup' ${missing[@]+"${missing[@]}"} libcatch2-dev
  [ -n "$dry_run" ] || printf 'carlo: installing %s Debian packages ...\n' "$((${#missing[@]} + 1))" >&2
  as_root apt-get -qq update
  if [ ${#missing[@]} != 0 ]; then
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install ${missing[@]+"${missing[@]}"}
  fi
  if ! is_catch2_version "$catch2"; then
    add_backports
    install_catch2
    catch2=$(installed_versions libcatch2-dev)
    case ${catch2#* } in
      [012].*) fail "Catch2 here is version ${catch2#* }, and Carlo needs 3: labs/README.md says how to install it" ;;
    esac
  fi
}

# --- Fedora, Arch, macOS -------------------------------------------------------------------------

# install_missing WHAT COMMAND... -- NAME...: installs those names as root.
install_missing() {
  local what=$1 command=()
  shift
  while [ "$1" != -- ]; do command+=("$1") && shift; done
  shift
  [ $# != 0 ] || return 0
  may_install "$what" 'as root: ./carlo setup' "$@"
  [ -n "$dry_run" ] || printf 'carlo: installing %s %s ...\n' $# "$what" >&2
  as_root ${command[@]+"${command[@]}"} "$@" || fail "not installed: see above"
}

setup_by_dnf() {
  local missing
  # Provided by another package, as zlib-devel is.
  read -ra missing <<<"$(LC_ALL=C rpm -q --whatprovides "$@" 2>&1 | sed -n 's/^no package provides //p' | tr '\n' ' ')"
  install_missing 'Fedora packages' dnf -q -y --setopt=install_weak_deps=False install -- ${missing[@]+"${missing[@]}"}
}

setup_by_pacman() {
  local missing
  read -ra missing <<<"$(pacman -T "$@" | tr '\n' ' ')"
  install_missing 'Arch packages' pacman -S --needed --noconfirm -- ${missing[@]+"${missing[@]}"}
}

# Homebrew belongs to the user and refuses root.
setup_by_brew() {
  local prefix=${HOMEBREW_PREFIX:-} missing=() name answer=n
  [ -n "$prefix" ] || prefix=$(brew --prefix)
  for name in "$@"; do
    [ -d "$prefix/opt/$name" ] || missing+=("$name")
  done
  if [ ${#missing[@]} != 0 ]; then
    if [ -n "$dry_run" ]; then
      printf 'brew install %s\n' "${missing[*]-}"
    else
      if [ "$verb" = setup ]; then answer=y; elif [ -t 0 ] && [ -t 2 ]; then
        printf 'Carlo needs from Homebrew: %s\nInstall them? [Y/n] ' "${missing[*]-}" >&2
        read -r answer
      fi
      case $answer in n* | N*) fail "these are missing: ${missing[*]-} (./carlo setup)" ;; esac
      printf 'carlo: installing %s Homebrew packages ...\n' ${#missing[@]} >&2
      brew install -q ${missing[@]+"${missing[@]}"} >/dev/null || fail "not installed: see above"
    fi
  fi
  stb_without_package "$prefix/include/stb"
}

# Gets the one header that Homebrew does not have, into FOLDER.
stb_without_package() {
  local header=stb_image_write.h
  local from=https://raw.githubusercontent.com/nothings/stb/master/$header
  [ ! -f "$1/$header" ] || return 0
  if [ -n "$dry_run" ]; then
    printf 'mkdir -p %s\ncurl -fsSL -o %s %s\n' "$1" "$1/$header" "$from"
  else
    fail "Homebrew has no $header; put it there: mkdir -p $1 && curl -fsSL -o $1/$header $from"
  fi
}
