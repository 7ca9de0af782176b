#!/usr/bin/env bash
# steps_test.sh SOURCE BUILD: steps of lab 8 that define the same helper each use their own; one
# that cannot be linked with the others loses only its own points.
set -euo pipefail
source=$1
build=$2

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 711 "$scratch"
class=$scratch/class

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# helper STEP NUMBER: gives a step a helper that the linker sees, and that ends the program if the
# step calls another step's helper.
helper() {
  cat >>"$1" <<EOF
#include <cstdlib>
namespace lab08 {
int helpings = $2;
__attribute__((noinline)) int helper(int x) { return x * helpings; }
static const bool own = helper(3) == 3 * $2 || (std::abort(), false);
}
EOF
}

for name in helpers missing; do
  mkdir -p "$class/$name"
  cp "$source"/solutions/08_path_tracer/steps/*.cpp "$class/$name/"
done
mkdir "$class/nothing"
echo 'later' >"$class/nothing/notes.txt"
helper "$class/helpers/b_direct.cpp" 2
helper "$class/helpers/c_phong.cpp" 3
helper "$class/helpers/h_path_tracer.cpp" 4
# And a step that also defines another step's exercise; that exercise keeps its own code.
cat >>"$class/helpers/h_path_tracer.cpp" <<'EOF'
#include <cstdlib>
namespace lab08 {
Rgb trace_direct(const World&, const Ray&, bool, Rng&) { std::abort(); }
}
EOF
echo 'namespace lab08 { int nowhere(); static const int lost = nowhere(); }' \
  >>"$class/missing/g_specular.cpp"

"$build/bin/carlo_grade" --tree "$source" --build "$build" "$class" --labs 8 -j 1 \
  -o "$scratch/out" | tee "$scratch/log" || fail "the grader ended with $?"

# Prints a student's points by exercise, 8.1 first.
points() { grep "^$1," "$scratch/out/class.csv" | cut -d, -f2-9; }

[ "$(points helpers)" = 1,3,3,3,2,2,2,4 ] ||
  fail "helpers of one name cost points, or a copy of an exercise took its place: $(points helpers)"
grep -q 'helper(int): several files define it' "$scratch/out/helpers/report.txt" ||
  fail "nobody says that helpers have one name"
case $(points missing) in
  1,3,3,3,2,2,0,*) ;;
  *) fail "a step that cannot be linked costs others: $(points missing)" ;;
esac
grep -q 'g_specular.cpp: cannot be linked' "$scratch/out/missing/report.txt" ||
  fail "nobody says which step cannot be linked"
grep -q 'lab08::nowhere() is called but never defined' "$scratch/out/missing/report.txt" ||
  fail "nobody says why"
grep -q 'none of its files was handed in' "$scratch/out/nothing/report.txt" ||
  fail "nobody says that the lab is missing"
echo passed
