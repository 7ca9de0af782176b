#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2"
truncate -s 300G "$2/integration.cpp"
