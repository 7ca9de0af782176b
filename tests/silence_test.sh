#!/usr/bin/env bash
# silence_test.sh SOURCE PRESET: no verb of ./carlo that takes long is silent for more than 15 s on a pipe
# or 2 s on a terminal, building included. Takes half an hour on two processors with nothing beside.
set -euo pipefail
source=$1
export CARLO_PRESET=$2 TERM=xterm
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
failures=0

# longest_silence LIMIT: copies stdin to the file `said`; exit code 1 if nothing came for longer than that.
longest_silence() {
  perl -e 'use Time::HiRes "time";
    open(my $said, ">", "said");
    my ($last, $longest, $before, $text) = (time, 0, "", "");
    for (;;) {
      my $n = sysread(STDIN, my $piece, 65536);
      my $silence = time - $last;
      ($longest, $before) = ($silence, $text) if $silence > $longest;
      last unless $n;
      $last = time;
      $text = substr($text . $piece, -120);
      syswrite($said, $piece);
    }
    $before =~ s/[^ -~]+/ /g;
    printf "%.1f s, after: %s\n", $longest, $before;
    exit($longest > $ARGV[0]);' "$1"
}

# talks VERB...: on a pipe, then on a terminal; each time without what `anew` builds, if that is set.
anew=
talks() {
  local terminal limit
  terminal=$(printf '%q ' "$source/carlo" "$@")
  for limit in 15 2; do
    # A verb on a terminal leaves a build in the background behind.
    [ -z "$anew" ] || until rm -rf "$anew"; do sleep 1; done
    printf './carlo %s: ' "$*"
    if [ "$limit" = 15 ]; then
      "$source/carlo" "$@" 2>&1 </dev/null | longest_silence "$limit"
    else
      script -qec "$terminal" /dev/null </dev/null | longest_silence "$limit"
    fi || {
      printf 'FAILED: at most %s s, or it failed: %s\n' "$limit" "$(tail -c 300 said)"
      failures=$((failures + 1))
    }
  done
}

for lab in "$source"/labs/[0-9]*/lab.json; do
  number=$(basename "$(dirname "$lab")")
  number=$((10#${number%%_*}))
  talks lab "$number" --solutions --no-page
  talks test "$number" --solutions
done
talks render --seconds 25 -o image
talks render "$source/common/scenes/knot.xml" --spp 256 -o image
talks bench --page page.html
talks slides --check
mkdir -p class/{one,two,three}
for student in one two three; do
  cp "$source/solutions/01_integration/integration.cpp" "class/$student"
done
talks grade class --labs 1 -o marks
# From nothing, without a cache of compilations.
git clone -q "$source" tree
source=$scratch/tree anew=$scratch/tree/build
export CCACHE_DISABLE=1
talks lab 1 --quick --no-page
talks render --size 32x32 --spp 1 -o image
printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
