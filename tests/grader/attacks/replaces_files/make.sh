#!/bin/sh
# make.sh DRAFT TARGET TREE: a whole tree is handed in, changed where it should not matter.
set -eu
mkdir -p "$2/labs/01_integration" "$2/common/random" "$2/tests/01_integration" "$2/tests/grader"
cp "$1/integration.cpp" "$2/labs/01_integration/"
{ echo '#define CARLO_REPLACED 1'; cat "$3/labs/01_integration/integration.h"; } \
  > "$2/labs/01_integration/integration.h"
{ echo '#define CARLO_REPLACED 1'; cat "$3/common/random/rng.h"; } > "$2/common/random/rng.h"
echo 'add_definitions(-DCARLO_REPLACED)' > "$2/CMakeLists.txt"
cp "$2/CMakeLists.txt" "$2/labs/CMakeLists.txt"
echo 'TEST_CASE("Lab 1.2: passes", "[lab01][ex2]") {}' > "$2/tests/01_integration/checks_average.cpp"
printf '#!/bin/sh\necho all tests passed\n' > "$2/carlo"
chmod +x "$2/carlo"
echo '{"lab": 1, "exercises": [{"tag": "Lab 1.2", "points": 100}]}' \
  > "$2/labs/01_integration/lab.json"
