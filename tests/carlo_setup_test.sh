#!/usr/bin/env bash
# carlo_setup_test.sh SOURCE VERBS: tests what ./carlo says if nothing is installed or built, and
# how it sets up a machine, with stand-ins for apt.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/stand_in_tree.sh"
rm -rf "$tree/build"

# called PATTERN: the log of calls has such a line; clears the log.
called() {
  grep -Eq -e "$1" "$scratch/calls" || failed "nobody called $1 but: $(cat "$scratch/calls")"
  : >"$scratch/calls"
}

# installed_nothing WHEN: apt was only queried.
installed_nothing() { ! grep -E -e '^(sudo|apt-get -qq)' "$scratch/calls" || failed "something was installed for $1"; }

# --- nothing is there ----------------------------------------------------------------------------

program "$tools/dpkg-query" 'exit 1'
expect 0 'usage: ./carlo VERB'
for verb in $(carlo | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p' | sort -u); do
  expect 0 "^(usage: ./carlo $verb|run.sh --build)" "$verb" --help
done
expect_error 'did you mean ./carlo test\?' tset
expect 0 'developer' setup --help
[ ! -e "$tree/build" ] || failed "something was built for a question"
installed_nothing "a question"

# A student's tree has fewer verbs, and says so for the others.
rm "$tree/solutions" "$tree/slides"
mv "$tree/tests" "$tree/all_tests"
expect 0 '^  render .*' --help
[ "$(carlo | grep -cE '^  (grade|bench|starter|gradescope|fuzz|site|slides) |--solutions|--mine')" = 0 ] || failed "of all trees: $(carlo)"
for verb in grade bench starter gradescope fuzz site slides; do expect_error "there is no ./carlo $verb in this folder" "$verb" --help; done
mv "$tree/labs/08_path_tracer" "$scratch/"
expect_error "there is no ./carlo render in this folder" render
! carlo | grep -q 'glossy walls' || failed "a verb that is not there has a line"
mv "$scratch/08_path_tracer" "$tree/labs/"
mv "$tree/all_tests" "$tree/tests"

# --- setting up ----------------------------------------------------------------------------------

program "$tools/apt-cache" 'echo n=bookworm-backports'
names='g\+\+ cmake .* bubblewrap'
expect 0 "^env .* install $names\$" setup --dry-run
expect 0 '^env .* install .*libcatch2-dev$' setup --dry-run
installed_nothing --dry-run
expect 0 ' shellcheck .* munge' setup --developer --dry-run
FAKE_ID=1000 expect 0 '^sudo env .* install g' setup --dry-run
FAKE_ID=1000 expect_error "^carlo: these Debian packages are missing: $names libcatch2-dev \(as root: ./carlo setup\)\$" status
expect 0 'installing 19 Debian packages' setup
called "^apt-get -qq -y --no-install-recommends install $names\$"
program "$tools/dpkg-query" 'for word in "$@"; do case $word in -*) ;; *) echo "installed $word 2.13.8-1" ;; esac; done'
[ -e /usr/local/lib/cmake/Catch2 ] || expect 1 'Catch2 here is version 2.13.8-1, and Carlo needs 3' setup
program "$tools/dpkg-query" 'for word in "$@"; do case $word in -*) ;; *) echo "installed $word 3.1-1" ;; esac; done'
expect 0 '^carlo: everything is installed$' setup
expect 0 '^carlo: everything is installed$' setup --dry-run

# Without apt: lists everything that is missing.
for tool in bash env cat awk dirname readlink tr id sed grep uniq; do ln -sf "$(command -v "$tool")" "$scratch/"; done
code=0
text=$(PATH=$scratch "$tree/carlo" setup 2>&1) || code=$?
[ "$code" = 1 ] && grep -q 'needs apt, which is not on this machine. Install these with your package manager (their names may differ): g++ cmake' <<<"$text" ||
  failed "without apt: exit code $code, $text"

finish
