#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the autograder's image: installs, builds, and
# grades the stub as a trial, so that a broken grader is noticed now and not by students.
set -euo pipefail
source=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
lab=$(cat "$source/lab")

fail() {
  printf 'carlo: %s\n' "$*" >&2
  exit 1
}

[ "$(id -u)" = 0 ] || fail "setup.sh must run as root"
# Ubuntu 22.04, Gradescope's default image, has no Catch2 3; Debian's package, a static library,
# works there. Checks its signature with the key that came with the zip.
catch2_from_debian() {
  local key=/usr/share/keyrings/carlo-debian.gpg
  cp "$source/debian-archive-keyring.gpg" "$key"
  chmod 644 "$key"
  printf 'deb [signed-by=%s] http://deb.debian.org/debian bookworm-backports main\n' "$key" \
    >/etc/apt/sources.list.d/carlo.list
  {
    printf 'Package: *\nPin: release o=Debian Backports\nPin-Priority: -1\n\n'
    printf 'Package: libcatch2-dev\nPin: release o=Debian Backports\nPin-Priority: 900\n'
  } >/etc/apt/preferences.d/carlo
  apt-get -qq update
  apt-get -qq -y --no-install-recommends install libcatch2-dev g++-12 >/dev/null
}

export DEBIAN_FRONTEND=noninteractive
. /etc/os-release
apt-get -qq update
case $ID:$VERSION_ID in
  debian:1[2-9]) ;;
  ubuntu:22.*)
    catch2_from_debian
    export CXX=g++-12 ;;
  ubuntu:2[4-9].*) ;;
  *) fail "the autograder needs Debian 12 or Ubuntu 22.04, this image is ${PRETTY_NAME:-unknown}" ;;
esac

# Only root can enter this folder. The grader runs student code under other users, with copies of
# what they may see; so the files themselves need not be closed to them.
umask 022
chown -R 0:0 "$source"
chmod -R u=rwX,go=rX "$source"
chmod 600 "$source/secret"
chmod 700 "$source"

# The image is kept for a term: leave nothing in it that only this build needs.
export CCACHE_DISABLE=1
cd "$source/carlo"
./carlo setup

trial=$(mktemp -d)
trap 'rm -rf "$trial"' EXIT
mkdir -p "$trial/stub"
cp -R "$source"/carlo/labs/[0-9]* "$trial/stub/"
./carlo grade --one "$trial/stub" --labs "$lab" --secret-file "$source/secret" -o "$trial/out" || {
  cat "$trial"/out/stub/report.txt >&2 || true
  fail "the trial run on the stub failed"
}
grep -q '"tests"' "$trial/out/stub/results.json" || fail "the trial run on the stub gave no results"
rm -rf /var/lib/apt/lists/*
printf 'carlo: the autograder of lab %s is ready\n' "$lab"
