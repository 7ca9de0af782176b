#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2/labs/01_integration"
cp "$1/integration.cpp" "$2/labs/01_integration/integration.cpp.txt"
echo 'I did it' > "$2/labs/01_integration/README.md"
