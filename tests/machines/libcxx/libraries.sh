#!/usr/bin/env bash
# libraries.sh FOLDER: builds Debian's sources of those C++ libraries whose interfaces use types of
# the standard library with LLVM's instead of GCC's, and installs them in FOLDER. As root, in its
# own Debian (chroot.sh libcxx); does not rebuild what is already installed. Embree, Highway,
# pugixml, libarchive and nettle are C, or nearly; OpenImageIO is behind a boundary
# (exr_boundary.h).
set -euo pipefail
folder=${1:?libraries.sh needs a folder}
mkdir -p "$folder/src"
sources=/etc/apt/sources.list.d/sources.list
if [ ! -f "$sources" ]; then
  # Also from the previous release: mirrors keep sources of point releases less reliably than
  # packages.
  sed 's/^deb /deb-src /; p; s/trixie/bookworm/' /etc/apt/sources.list >"$sources"
  apt-get -qq update
fi

# library PACKAGE OPTION...
library() {
  local package=$1 source
  shift
  [ ! -f "$folder/$package.done" ] || return 0
  printf '%s ...\n' "$package"
  rm -rf "$folder/src/$package" && mkdir "$folder/src/$package"
  (cd "$folder/src/$package" && { apt-get -qq source "$package" || apt-get -qq source -t bookworm "$package"; } >/dev/null 2>&1) ||
    { printf 'libraries.sh: no source of %s\n' "$package" >&2 && exit 1; }
  source=$(find "$folder/src/$package" -mindepth 1 -maxdepth 1 -type d)
  cmake -G Ninja -S "$source" -B "$source/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS=-stdlib=libc++ -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_TESTING=OFF \
    "$@" >"$source.log" 2>&1 && ninja -C "$source/build" install >>"$source.log" 2>&1 || { tail -20 "$source.log" && exit 1; }
  : >"$folder/$package.done"
}

library fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
# Embree and OpenImageIO also load Debian's own, so ours is static: no loader finds it by name.
library onetbb -DTBB_TEST=OFF -DTBB_STRICT=OFF -DBUILD_SHARED_LIBS=OFF -DTBBMALLOC_BUILD=OFF
library catch2 -DCATCH_INSTALL_DOCS=OFF
