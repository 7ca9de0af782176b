#!/usr/bin/env bash
# start_test.sh PROGRAM...: none of them loads OpenImageIO, whose 250 shared libraries take .2 s to
# load: a class needs thousands of judges, and a student starts a lab many times.
set -euo pipefail

status=0
for program in "$@"; do
  if ldd "$program" | grep OpenImageIO; then
    printf '%s loads OpenImageIO: what reads EXR files belongs to carlo::exr alone\n' "$program"
    status=1
  fi
done
exit $status
