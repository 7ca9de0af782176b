#!/usr/bin/env bash
# in_turn.sh BUILD [--keep FOLDER PROGRAM ... --] COMMAND...: runs a command that writes into the folder
# BUILD, and nobody else's at the same time: two ninjas in one folder write the same files. With --keep
# these programs of BUILD/bin are copied into FOLDER before the next has its turn, so that a program that
# runs is never one that is being linked.
#
# Whoever has to wait is told on descriptor 3, if there is one, for whom. The lock belongs to all that the
# command starts: it goes when the last of them has ended, whoever was killed. Exit code: the command's.
set -euo pipefail
build=$1 folder='' programs=()
shift
if [ "$1" = --keep ]; then
  folder=$2
  shift 2
  while [ "$1" != -- ]; do programs+=("$1") && shift; done
  shift
fi

# Where there is no flock, nobody waits.
if command -v flock >/dev/null; then
  exec 9<>"$build/.turn"
  if ! flock -n 9; then
    read -r holder <"$build/.turn" || true
    { printf 'carlo: waiting for %s, which builds in the same folder ...\n' "${holder:-another ./carlo}" >&3; } 2>/dev/null || true
    flock 9
  fi
  printf '%s\n' "${CARLO_TURN_OF:-another program}" >"$build/.turn"
fi
"$@" 3>&-
if [ -n "$folder" ]; then
  mkdir -p "$folder"
  # Not into a copy that still runs.
  for program in ${programs[@]+"${programs[@]}"}; do rm -f "$folder/$program" && cp -p "$build/bin/$program" "$folder/"; done
fi
