#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$1/x"
cp "$1/integration.cpp" "$1/x/z.cpp"
truncate -s 20G "$1/x/integration.cpp"
tar -C "$1/x" -S -cf "$1/sparse.tar" integration.cpp
gzip -c "$1/sparse.tar" > "$2.tar.gz"
