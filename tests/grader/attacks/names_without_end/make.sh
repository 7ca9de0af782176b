#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
name=$(head -c 100000 /dev/zero | tr '\0' n)
mkdir -p "$1/x"
for i in $(seq 100 299); do : > "$1/x/m$i"; done
cp "$1/integration.cpp" "$1/x/"
case $2 in /*) to=$2 ;; *) to=$PWD/$2 ;; esac
(cd "$1/x" && tar --format=pax --transform "s,^m,$name," -czf "$to.tar.gz" -- *)
rm -r "$1/x"
