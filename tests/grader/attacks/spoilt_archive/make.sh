#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
tar -C "$1" -czf "$1/whole.tar.gz" integration.cpp
head -c 500 "$1/whole.tar.gz" > "$2.tar.gz"
