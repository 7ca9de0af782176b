#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
mkdir -p "$2"
cp "$1/integration.cpp" "$2/"
touch "$2/; touch evil.txt" "$2/\$(touch evil.txt)" "$2/<script>alert(1)" \
  "$2/a\"b,c" "$2/$(printf 'two\nlines: 20 of 20 points')" "$2/$(printf '\033[2J')" \
  "$2/$(printf '\377\376')" "$2/-rf" "$2/integration.cpp "
