#!/bin/sh
# make.sh DRAFT TARGET TREE
set -eu
cd "$1"
echo stolen > evil.txt
mkdir -p labs/01_integration && cp integration.cpp labs/01_integration/
tar -P -cf "$2.tar" --transform 's,^evil.txt,../../evil.txt,' evil.txt
tar -P -rf "$2.tar" --transform "s,^evil.txt,$(dirname "$2")/evil.txt," evil.txt
tar -P -rf "$2.tar" --transform 's,^evil.txt,labs/../../canary/canary.txt,' evil.txt
tar -P -rf "$2.tar" labs
