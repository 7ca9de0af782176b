#!/usr/bin/env bash
# killed_test.sh SOURCE BUILD LEVEL: a grader that is killed (kill -9) leaves no process behind at
# that level of the sandbox: not the judge, not the student's program, not processes that the
# program has moved into sessions of their own.
set -euo pipefail
source=$1
build=$2
level=$3

scratch=$(mktemp -d)
export TMPDIR=$scratch/tmp
mkdir "$TMPDIR"
chmod 711 "$scratch" "$TMPDIR"
left() { pgrep -f "^$TMPDIR/.*lab01_worker" || true; }
cleanup() {
  left | xargs -r kill -9
  rm -rf "$scratch"
}
trap cleanup EXIT

mkdir -p "$scratch/class/scatters"
sed -e '1i #include <unistd.h>' \
  -e 's|^double average(.*{$|&\n  for (int i = 0; i < 4; ++i)\n    if (::fork() == 0) {\n      ::setpgid(0, 0);\n      if (::fork() != 0) ::_exit(0);\n      while (true) ::sleep(100);\n    }\n  ::sleep(100);|' \
  "$source/solutions/01_integration/integration.cpp" >"$scratch/class/scatters/integration.cpp"
grep -q sleep "$scratch/class/scatters/integration.cpp"

setsid "$build/bin/carlo_grade" --tree "$source" --build "$build" "$scratch/class" --labs 1 \
  --sandbox "$level" -o "$scratch/out" >"$scratch/log" 2>&1 &
grader=$!
for ((i = 0; i < 6000; ++i)); do
  [ "$(left | wc -l)" -lt 5 ] || break
  if ! kill -0 "$grader" 2>/dev/null; then
    if grep -q 'does not work on this machine\|would run as root' "$scratch/log"; then
      echo "SKIPPED: $(cat "$scratch/log")"
      exit 77
    fi
    echo "FAILED: it ended: $(cat "$scratch/log")"
    exit 1
  fi
  sleep 0.1
done
[ "$(left | wc -l)" -ge 5 ] || { echo 'FAILED: the program never ran' && exit 1; }
kill -9 "$grader"
wait "$grader" 2>/dev/null || true
for ((i = 0; i < 100; ++i)); do
  [ -n "$(pgrep -f "$scratch" || true)" ] || break
  sleep 0.1
done
if pgrep -fa "$scratch"; then
  echo "FAILED: these outlived the grader"
  exit 1
fi
echo passed
