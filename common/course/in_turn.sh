#!/usr/bin/env bash
# in_turn.sh BUILD [--keep FOLDER PROGRAM ... --] COMMAND...: runs a command that writes into the
# folder BUILD while no other does: two ninjas in one folder write the same files. With --keep,
# copies these programs of BUILD/bin into FOLDER before releasing the lock, so that a running
# program is never one that is being linked.
#
# While waiting, writes the holder's name to descriptor 3, if it is open. The lock belongs to
# everything that the command starts: it is released when the last of them has ended, whichever was
# killed. Exit code: the command's.
set -euo pipefail
build=$1 folder='' programs=()
shift
if [ "$1" = --keep ]; then
  folder=$2
  shift 2
  while [ "$1" != -- ]; do programs+=("$1") && shift; done
  shift
fi

# lock [-n]: locks descriptor 9. flock is Linux's; macOS has Perl, whose lock also belongs to the
# open file.
lock() {
  if command -v flock >/dev/null; then flock "$@" 9; else
    perl -e 'open my $file, "+<&=", 9 or die; exit !flock $file, @ARGV ? 2 | 4 : 2' -- "$@"
  fi
}

# With neither, nobody waits.
if command -v flock >/dev/null || command -v perl >/dev/null; then
  exec 9<>"$build/.turn"
  if ! lock -n; then
    read -r holder <"$build/.turn" || true
    { printf 'carlo: waiting for %s, which builds in the same folder ...\n' "${holder:-another ./carlo}" >&3; } 2>/dev/null || true
    lock
  fi
  printf '%s\n' "${CARLO_TURN_OF:-another program}" >"$build/.turn"
fi
"$@" 3>&-
if [ -n "$folder" ]; then
  mkdir -p "$folder"
  # Never overwrite a copy that is still running.
  for program in ${programs[@]+"${programs[@]}"}; do rm -f "$folder/$program" && cp -p "$build/bin/$program" "$folder/"; done
fi
