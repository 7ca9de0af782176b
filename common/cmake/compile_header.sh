#!/bin/sh
# compile_header.sh COMMAND...: precompiles headers, and puts a checksum beside what COMMAND's -o names.
# By it the compiler cache (ccache's pch_external_checksum) knows them for each of hundreds of files,
# without reading their 100 MB each time.
set -eu
"$@"
before='' header=''
for argument; do
  [ "$before" != -o ] || header=$argument
  before=$argument
done
case $header in
  *.gch | *.pch)
    ccache --hash-file "$header" >"$header.sum.part"
    mv "$header.sum.part" "$header.sum"
    ;;
esac
