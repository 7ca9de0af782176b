#!/bin/sh
# compile_header.sh CCACHE COMMAND...: precompiles headers and writes a checksum next to COMMAND's
# -o output. The compiler cache (its pch_external_checksum) identifies them by it for each of
# hundreds of files, without reading their 100 MB each time. If it is missing, as after a kill, the
# cache reads them.
set -eu
ccache=$1
shift
before='' header=''
for argument; do
  [ "$before" != -o ] || header=$argument
  before=$argument
done
case $header in *.gch | *.pch) ;; *) exec "$@" ;; esac
rm -f "$header.sum" # a checksum of other headers would be worse than none
"$@"
"$ccache" --hash-file "$header" >"$header.sum.part"
mv "$header.sum.part" "$header.sum"
