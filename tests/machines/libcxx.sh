#!/usr/bin/env bash
# libcxx.sh: set-up for clang with LLVM's standard library, inside its own Debian (chroot.sh
# libcxx), as root: the packages of ./carlo setup, the compiler, and the libraries that must be
# rebuilt (libcxx/libraries.sh).
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
"$root/carlo" setup
DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install clang libc++-dev libc++abi-dev dpkg-dev >/dev/null
"$root/tests/machines/libcxx/libraries.sh" /opt/libcxx
