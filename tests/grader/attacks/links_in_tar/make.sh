#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$1/x/a" "$1/x/b" "$1/x/c"
ln -s "$3/solutions/01_integration/integration.cpp" "$1/x/a/integration.cpp"
mkfifo "$1/x/b/integration.cpp"
ln -s /etc/passwd "$1/x/other"
ln "$1/x/other" "$1/x/c/integration.cpp"
tar -C "$1/x" -czf "$2.tar.gz" .
