#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the autograder's image: installs, builds, and
# grades the stub as a trial, so that a grader that does not work is seen now and not by students.
set -euo pipefail
source=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
lab=$(cat "$source/lab")

fail() {
  printf 'carlo: %s\n' "$*" >&2
  exit 1
}

[ "$(id -u)" = 0 ] || fail "setup.sh must run as root"
. /etc/os-release
case $ID:${VERSION_ID%%.*} in
  debian:1[2-9]) ;;
  *) fail "the autograder needs Debian 12, this image is ${PRETTY_NAME:-unknown}: see tests/INSTRUCTORS.md" ;;
esac

# The grader runs student code under another user. Of what stands here that user may read the library
# and the handed-out labs; not the solutions, the tests, the secret.
chown -R 0:0 "$source"
chmod -R u=rwX,go=rX "$source"
chmod 700 "$source/carlo/tests"
[ ! -d "$source/carlo/solutions" ] || chmod 700 "$source/carlo/solutions"
chmod 600 "$source/secret"

# The image is kept for a term: nothing that only this build needs stays in it.
export CCACHE_DISABLE=1
cd "$source/carlo"
apt-get -qq update
./carlo setup

trial=$(mktemp -d)
trap 'rm -rf "$trial"' EXIT
mkdir -p "$trial/stub"
cp -R "$source"/carlo/labs/[0-9]* "$trial/stub/"
./carlo grade "$trial/stub" --labs "$lab" --secret-file "$source/secret" -o "$trial/out"
grep -q '"tests"' "$trial/out/stub/results.json" || fail "the trial run on the stub gave no results"
rm -rf /var/lib/apt/lists/*
printf 'carlo: the autograder of lab %s is ready\n' "$lab"
