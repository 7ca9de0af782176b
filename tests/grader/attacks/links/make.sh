#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2/a" "$2/b" "$2/c"
ln -s "$3/solutions/01_integration/integration.cpp" "$2/a/integration.cpp"
ln -s /dev/zero "$2/b/integration.cpp"
mkfifo "$2/c/integration.cpp"
ln -s "$3/solutions" "$2/labs"
ln -s . "$2/self"
