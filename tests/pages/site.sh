#!/usr/bin/env bash
# site.sh PROGRAMS FOLDER: makes the site in FOLDER/site and drives it (site.test.mjs). Exit code 77: skipped,
# also where CARLO_BROWSER_TESTS is "required": Emscripten, 800 MB, is no developer's package.
set -euo pipefail
programs=$1 folder=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)

skip() { printf 'skipped: %s\n' "$*" && exit 77; }

command -v emcc >/dev/null || skip "Emscripten is not installed (./carlo site installs it)"
[ -f "$root/build/slides/node_modules/katex/package.json" ] || skip "KaTeX is not installed (./carlo site installs it)"
mkdir -p "$folder"
node "$root/slides/site/site.mjs" "$programs" "$folder/site"
CARLO_SITE=$folder/site CARLO_SITE_NATIVE=$programs/carlo_site_native "$here/run.sh" site.test.mjs "$folder"
