#!/usr/bin/env bash
# in_turn.sh BUILD [--keep FOLDER PROGRAM ... --] COMMAND...: runs a command that writes into the
# folder BUILD while no other does: two ninjas in one folder write the same files. With --keep,
# copies these programs of BUILD/bin into FOLDER before releasing the lock, so that a running
# program is never one that is being linked.
#
# With --behind instead: at low priority, only while no other command wants its turn; does nothing if
# one runs already. What it has built until then stays.
#
# While waiting, writes the holder's name to descriptor 3, if it is open. The lock belongs to
# everything that the command starts: it is released when the last of them has ended, whichever was
# killed. Exit code: the command's.
set -euo pipefail
build=$1 folder='' programs=()
shift
if [ "$1" = --behind ]; then
  shift
  command -v flock >/dev/null || exit 0
  trap '' HUP
  exec 9<>"$build/.turn"
  flock -n 9 || exit 0
  printf 'behind\n' >"$build/.turn"
  nice -n 10 "$@" </dev/null >"$build/behind.log" 2>&1 &
  while kill -0 $! 2>/dev/null; do
    [ ! -e "$build/.wanted" ] || kill $! 2>/dev/null || true
    sleep .1 9>&-
  done
  exit 0
fi
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
    touch "$build/.wanted"
    read -r holder <"$build/.turn" || true
    [ "$holder" = behind ] || { printf 'carlo: waiting for %s, which builds in the same folder ...\n' "${holder:-another ./carlo}" >&3; } 2>/dev/null || true
    flock 9
  fi
  # Also one that was left by a command killed while it waited.
  rm -f "$build/.wanted"
  printf '%s\n' "${CARLO_TURN_OF:-another program}" >"$build/.turn"
fi
"$@" 3>&-
if [ -n "$folder" ]; then
  mkdir -p "$folder"
  # Never overwrite a copy that is still running.
  for program in ${programs[@]+"${programs[@]}"}; do rm -f "$folder/$program" && cp -p "$build/bin/$program" "$folder/"; done
fi
