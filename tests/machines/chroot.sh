#!/usr/bin/env bash
# chroot.sh [SUITE] [--keep]: the README's first command in a bare Debian (default: bookworm), made with
# debootstrap in a folder of its own below build/: does set-up install all that is needed? As root.
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
suite=bookworm keep=''
for word in "$@"; do
  case $word in
    --keep) keep=yes ;;
    -*) printf 'chroot.sh: takes a suite and --keep, got %s\n' "$word" >&2 && exit 1 ;;
    *) suite=$word ;;
  esac
done
[ "$(id -u)" = 0 ] || { printf 'chroot.sh: needs root\n' >&2 && exit 1; }
command -v debootstrap >/dev/null || { printf 'chroot.sh: debootstrap is missing (apt-get install debootstrap)\n' >&2 && exit 1; }
mkdir -p "$root/build"
folder=$(mktemp -d "$root/build/chroot.XXXXXX")
clean() {
  umount "$folder/proc" "$folder/dev" 2>/dev/null || true
  [ -n "$keep" ] || rm -rf --one-file-system "$folder"
}
trap clean EXIT
# The mirror that this machine uses already.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2>/dev/null | grep -m1 '/debian/\?$' || true)
debootstrap --variant=minbase "$suite" "$folder" "${mirror:-http://deb.debian.org/debian}" >"$folder.log" ||
  { tail -5 "$folder.log" >&2 && exit 1; }
rm -f "$folder.log"
cp /etc/resolv.conf "$folder/etc/" 2>/dev/null || true
cp -r /etc/apt/apt.conf.d/. "$folder/etc/apt/apt.conf.d/" 2>/dev/null || true
mount -t proc proc "$folder/proc"
mount --bind /dev "$folder/dev"
mkdir -p "$folder/carlo"
git -C "$root" archive HEAD | tar -x -C "$folder/carlo"
chroot "$folder" /carlo/carlo render --size 64x64 --spp 16
