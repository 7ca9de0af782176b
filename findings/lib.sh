# shellcheck shell=bash
# Shared by the scripts here: a temporary folder that goes away, and pinned packages inside it.
# Sourcing it changes into that folder.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"

# hold(condition, text): ends with one line if the behaviour is no longer as stated.
cat > hold.py <<'PY'
import sys
def hold(ok, text):
    if not ok:
        sys.exit("changed: " + text)
PY
cat > hold.h <<'CPP'
#include <cstdio>
#include <cstdlib>
inline void hold(bool ok, const char* text) {
    if (!ok) { std::fprintf(stderr, "changed: %s\n", text); std::exit(1); }
}
CPP

python_with() {  # python_with 'package==version'...: then use venv/bin/python
    python3 -m venv venv
    venv/bin/pip install --quiet --disable-pip-version-check "$@"
}

debian_with() {  # debian_with package=version...: unpacked below root/, nothing is installed
    apt-get download "$@" > apt.log 2>&1 || { tail -n 1 apt.log >&2; return 1; }
    local deb
    for deb in *.deb; do dpkg -x "$deb" root; done
}
