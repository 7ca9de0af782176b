#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$1/a/b"
cp "$1/integration.cpp" "$1/a/b/"
echo stolen > "$1/evil.txt"
cd "$1/a/b"
cmake -E tar cf "$2.zip" --format=zip ../../evil.txt integration.cpp
