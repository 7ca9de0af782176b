# shellcheck shell=bash
# Systems in folders: made by debootstrap, entered as if the machine had booted from them. Sourced.

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# needs_root_and PROGRAM...
needs_root_and() {
  local program
  [ "$(id -u)" = 0 ] || fail "needs root"
  for program in "$@"; do
    command -v "$program" >/dev/null || fail "needs $program (as root: apt-get install $program)"
  done
}

# Prints the mirror that this machine already uses.
debian_mirror() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    grep -m1 '/debian/\?$') || true
  printf '%s' "${mirror:-http://deb.debian.org/debian}"
}

# base_system SUITE FOLDER FRESH [OPTION...]: makes it with debootstrap unless it exists; restarts
# an interrupted one. With FRESH, renews everything but the base system, which is kept as an archive
# beside the folder.
base_system() {
  local suite=$1 folder=$2 fresh=$3 packed=${2%/*}/$1.tar
  shift 3
  if [ ! -f "$packed" ]; then
    printf '\n=== %s: base system, %s\n' "$(basename "$folder")" "$(date +%H:%M:%S)"
    rm -rf --one-file-system "$folder"
    # Its mounts disappear with it, however it ends: nothing of this machine may be in a folder that
    # is deleted.
    unshare --mount --propagation private \
      debootstrap --variant=minbase "$@" "$suite" "$folder" "$(debian_mirror)" >"$folder.debootstrap.log" ||
      { tail -5 "$folder.debootstrap.log" >&2 && fail "debootstrap failed"; }
    # The proxy settings for the mirror.
    { apt-config dump | grep -i '^Acquire::.*proxy' || true; printf 'Acquire::Retries "3";\n'; } \
      >"$folder/etc/apt/apt.conf.d/mirror"
    chroot "$folder" apt-get clean
    tar -C "$folder" -cf "$packed.part" . && mv "$packed.part" "$packed"
  elif [ -n "$fresh" ] || [ ! -x "$folder/bin/bash" ]; then
    rm -rf --one-file-system "$folder"
    mkdir -p "$folder" && tar -C "$folder" -xf "$packed"
  fi
  cp /etc/resolv.conf "$folder/etc/" 2>/dev/null || true
}

# clean_clone TREE FOLDER: clones only the last commit of TREE; what was built of an earlier one
# stays.
clean_clone() {
  local tree=$1 folder=$2 commit
  commit=$(git -C "$tree" rev-parse HEAD)
  [ -z "$(git -C "$tree" status --porcelain)" ] ||
    printf '%s: what is not committed is left out\n' "$(basename "$0")" >&2
  [ -d "$folder/.git" ] || git clone -q --no-checkout --no-hardlinks "$tree" "$folder"
  git -C "$folder" fetch -q "$tree" HEAD
  git -C "$folder" checkout -q --force --detach "$commit"
  git -C "$folder" clean -qffd
}

# inside FOLDER COMMAND...: runs it in the tree there. Not by chroot: there the kernel makes no user
# namespaces, and the judge's sandbox would differ from a real machine's. All its processes and
# mounts end with it.
inside() {
  local folder=$1
  shift
  unshare --mount --propagation private --pid --fork --kill-child bash -c '
    set -e
    mount --rbind "$1" "$1" && cd "$1"
    mount -t proc proc proc && mount --rbind /sys sys && mount --rbind /dev dev
    mkdir -p tmp run .old
    mount -t tmpfs -o mode=1777 tmpfs tmp
    pivot_root . .old && cd / && umount -l /.old
    shift
    cd /carlo && exec env -i CARLO_PRESET="${CARLO_PRESET:-release}" HOME=/root LC_ALL=C.UTF-8 TERM="${TERM:-dumb}" USER=root LOGNAME=root \
      PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"' inside "$folder" "$@"
}
