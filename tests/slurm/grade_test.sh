#!/usr/bin/env bash
# grade_test.sh SOURCE BUILD: grades a class of eight as a job array over four nodes: one cannot
# grade, one fails, a task is killed, and two processes wait for the same class. class.csv equals
# one machine's, byte for byte; nothing is graded twice, and nothing is left to do.
set -euo pipefail
source=$(readlink -f "$1") build=$(readlink -f "$2")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# grade OUT OPTION...
class=class
grade() {
  local out=$1
  shift
  "$build/bin/carlo_grade" --tree "$source" --build "$build" "$class" --secret-file secret -o "$out" "$@"
}

records() { find cluster -name record.json 2>/dev/null | wc -l; }

# until_within SECONDS WHAT COMMAND...
until_within() {
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    ((SECONDS < until)) || fail "waited in vain for $what: $(squeue; tail cluster/.slurm/*.txt)"
    sleep .1
  done
}

some_records() { [ "$(records)" -gt 0 ]; }
at_work_on() { [ -n "$(squeue --noheader --states RUNNING --nodelist "$1")" ]; }
said_by() { grep -qs "^$1: [0-9]" cluster/.slurm/*.txt; }
has_refused() { [ -e "cluster/.slurm/refused/$1" ]; }

inside() {
  local no_node
  # Takes a node's sandbox away or, where there is none to take, gives it another linker version,
  # whose marks might differ.
  if grep -q 'sandbox: bubblewrap' whole.log; then
    no_node='level "bubblewrap"'
    "$CARLO_CLUSTER" on node4 mount --bind /dev/null "$(readlink -f "$(command -v bwrap)")"
  else
    no_node='it compiles with .*of another world'
    printf '#!/bin/sh\necho GNU ld of another world\n' >ld
    chmod +x ld
    "$CARLO_CLUSTER" on node4 mount --bind "$PWD/ld" "$(readlink -f /usr/bin/ld)"
  fi
  grade cluster --slurm --tasks 7 --time 30 --no-wait | tee first.log
  grep -q '^job [0-9]*: 7 tasks for 8 submissions' first.log || fail 'no job was submitted'
  until_within 300 'the node that cannot grade' has_refused node4
  until_within 300 'a task on node2' said_by node2
  "$CARLO_CLUSTER" on node2 bash -c "kill -KILL \$(pgrep -f -- '--task $PWD/' | head -n 1)"
  until_within 300 'a task on node1' said_by node1
  ! at_work_on node1 || "$CARLO_CLUSTER" crash node1
  scontrol update NodeName=node1 State=DOWN Reason=power
  # While tasks are running nobody grades here.
  ! grade cluster >here.log 2>&1 || fail 'one machine grades where tasks are at work'
  grep -q 'another grader is at work there' here.log || fail "nobody says why: $(cat here.log)"
  grade cluster --slurm --no-wait >again.log
  grep -q 'the same command, later' again.log || fail "typed again: $(cat again.log)"
  ! grep -q 'tasks for' again.log || fail 'submitted twice'

  local first second
  grade cluster --slurm --tasks 3 >wait1.log 2>&1 &
  first=$!
  grade cluster --slurm --tasks 3 >wait2.log 2>&1 &
  second=$!
  "$CARLO_CLUSTER" up node1 2>/dev/null
  "$CARLO_CLUSTER" hurry
  wait "$first" || fail "the first one ended with $?: $(cat wait1.log)"
  wait "$second" || fail "the second one ended with $?: $(cat wait2.log)"
  cmp whole/class.csv cluster/class.csv || fail 'the class was graded otherwise'
  grep -q "node4 has graded nobody: .*$no_node" wait1.log ||
    fail "nobody tells of the node that cannot grade: $(cat wait1.log)"
  ! grep -q '^node4: ' cluster/.slurm/*.txt || fail 'a node graded that may not'

  # A repetition has nothing to do, here or there.
  rm cluster/class.csv
  grade cluster --slurm >third.log 2>&1 || fail "typed a third time: $(cat third.log)"
  ! grep -q 'tasks for' third.log || fail 'what was done was submitted again'
  cmp whole/class.csv cluster/class.csv || fail 'from the records comes another class.csv'
  grade cluster >here.log || fail "one machine goes on: $(cat here.log)"
  [ "$(grep -c '(as before)' here.log)" = 8 ] || fail "what the cluster graded is graded again: $(cat here.log)"
  # A submission is done when its line, with its time, is written.
  local twice
  twice=$(sed -n 's/^\([a-z_0-9]*\): [0-9.]* of [0-9]* points ([0-9].*/\1/p' cluster/.slurm/*.txt | sort | uniq -d)
  [ -z "$twice" ] || fail "graded twice: $twice"
}

# The folder for marks is full or not writable, and later is.
bad_folders() {
  local class=few
  mkdir -p few/{a,b} small
  mount -t tmpfs -o size=36k none small
  ! grade small --slurm >full.log 2>&1 || fail 'a class is graded on a full disk'
  grep -q '^error: ' full.log || fail "nobody says that the disk is full: $(cat full.log)"
  mount -o remount,size=64m small
  grade small --slurm >full.log 2>&1 || fail "there is room again: $(cat full.log)"
  mount -o remount,ro small
  ! grade small --slurm >full.log 2>&1 || fail 'a class is graded where nothing can be written'
  grep -q '^error: .*Read-only file system' full.log || fail "nobody says that nothing can be written: $(cat full.log)"
  grade few_here >/dev/null
  cmp few_here/class.csv small/class.csv || fail 'after a full disk the class.csv is another'
  umount small
}

if [ "${3:-}" = inside ]; then
  inside
  bad_folders
  exit
fi
"$here/cluster.sh" run --nodes 1 true || exit
work=$(mktemp -d)
chmod 711 "$work"
trap 'rm -rf "$work"' EXIT
"$here/make_class.sh" "$source" "$build" "$work/made" 2 2 3
cd "$work/made"
mkdir -p class/nothing
echo 'a secret of this test' >secret
! grade refused --tasks 3 >log 2>&1 || fail '--tasks without --slurm'
grep -q -- '--tasks is for --slurm' log || fail "nobody says what --tasks is for: $(cat log)"
! PATH=/nowhere grade refused --slurm >log 2>&1 || fail 'there is no Slurm'
grep -q 'there is no sbatch here' log || fail "nobody says that there is no Slurm: $(cat log)"
[ ! -e refused ] || fail 'a refused command has made a folder'

grade whole -j 2 | tee whole.log
"$here/cluster.sh" run "$here/grade_test.sh" "$source" "$build" inside
echo passed
