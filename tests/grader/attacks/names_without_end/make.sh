#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
name=$(head -c 100000 /dev/zero | tr '\0' n)
mkdir -p "$1/x"
for i in $(seq 100 299); do : > "$1/x/m$i"; done
cp "$1/integration.cpp" "$1/x/"
tar -C "$1/x" --format=pax --transform "s,^m,$name," -czf "$2.tar.gz" $(ls "$1/x")
rm -r "$1/x"
