#!/bin/sh
# compile_header.sh CCACHE COMMAND...: precompiles headers, and puts a checksum beside what COMMAND's -o
# names. By it the compiler cache (its pch_external_checksum) knows them for each of hundreds of files,
# without reading their 100 MB each time. Without it, as where this is killed, it reads them.
set -eu
ccache=$1
shift
before='' header=''
for argument; do
  [ "$before" != -o ] || header=$argument
  before=$argument
done
case $header in *.gch | *.pch) ;; *) exec "$@" ;; esac
rm -f "$header.sum" # that of other headers would be worse than none
"$@"
"$ccache" --hash-file "$header" >"$header.sum.part"
mv "$header.sum.part" "$header.sum"
