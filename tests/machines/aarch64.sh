#!/usr/bin/env bash
# aarch64.sh: set-up for 64-bit ARM, inside its own Debian (chroot.sh aarch64), as root: this
# machine's compiler for ARM, the ARM versions of the libraries that ./carlo setup would install,
# and ARM programs run by QEMU, which must be registered on the machine outside (binfmt).
set -euo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
export DEBIAN_FRONTEND=noninteractive

dpkg --add-architecture arm64
apt-get -qq update
native=(g++-aarch64-linux-gnu) foreign=(libc6-dev:arm64)
read -ra packages <<<"$(awk '$1 == "build" {printf "%s ", $2}' "$root/common/course/setup.sh")"
for package in "${packages[@]}"; do
  case $package in
    *-dev)
      # Packages for all architectures have no separate ARM version.
      [ "$(apt-cache show "$package" | awk '/^Architecture:/ {print $2; exit}')" = all ] || package+=:arm64
      foreign+=("$package") ;;
    *) native+=("$package") ;;
  esac
done
apt-get -qq -y --no-install-recommends install "${native[@]}" "${foreign[@]}" >/dev/null
printf 'int main() {}\n' | aarch64-linux-gnu-g++ -x c++ -o /tmp/runs - && /tmp/runs ||
  { printf 'aarch64.sh: programs of ARM do not run here: install qemu-user-static outside, which registers it with binfmt_misc\n' >&2 && exit 1; }
