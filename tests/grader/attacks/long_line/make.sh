#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2"
{ cat "$1/integration.cpp"; printf 'int x = '; head -c 1000000 /dev/zero | tr '\0' '('; } \
  > "$2/integration.cpp"
