#!/usr/bin/env bash
# run.sh TEST FOLDER [RENDERER]: runs TEST, viewer.test.mjs or site.test.mjs; with RENDERER renders the page that
# the first drives. FOLDER keeps the packages of package-lock.json from one run to the next. Exit code 77: skipped.
set -euo pipefail
test=$1 folder=$2 renderer=${3:-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

skip() {
  printf 'skipped: %s\n' "$*"
  [ "${CARLO_BROWSER_TESTS:-}" = required ] || exit 77
  printf 'but CARLO_BROWSER_TESTS is "required"\n' >&2
  exit 1
}

command -v node >/dev/null || skip "node is not installed (./carlo setup --developer)"
command -v npm >/dev/null || skip "npm is not installed (./carlo setup --developer)"
CARLO_CHROMIUM=$(command -v chromium || command -v chromium-browser) ||
  skip "Chromium is not installed (./carlo setup --developer)"
export CARLO_CHROMIUM

mkdir -p "$folder"
cp "$here/package.json" "$here"/*.test.mjs "$folder"
cd "$folder"
if ! cmp -s "$here/package-lock.json" package-lock.json || [ ! -d node_modules ]; then
  cp "$here/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error ||
    { rm -rf node_modules && skip "npm cannot fetch playwright-core"; }
fi

[ -n "$renderer" ] || exec node --test --test-reporter=spec "$test"
"$renderer" "$here/halves.xml" -o reference -D 'light=0.5, 0.5, 0.5' --quiet
"$renderer" "$here/halves.xml" -o halves --reference reference.exr --page "$folder/page.html" --quiet
CARLO_PAGE=$folder/page.html exec node --test --test-reporter=spec "$test"
