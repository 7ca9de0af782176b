#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$1/x"
truncate -s 60M "$1/zeros"
cp "$1/zeros" "$1/x/integration.cpp"
tar -C "$1/x" -czf "$1/inner.tar.gz" integration.cpp
mkdir "$1/y"
for i in $(seq 400); do ln "$1/inner.tar.gz" "$1/y/$i.tar.gz"; done
tar --hard-dereference -C "$1/y" -cf "$2.tar" .
