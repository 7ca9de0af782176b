#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2/labs/01_integration/old"
cp "$1/integration.cpp" "$2/labs/01_integration/"
{ cat "$1/integration.cpp"; echo '// older'; } > "$2/labs/01_integration/old/integration.cpp"
