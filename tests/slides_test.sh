#!/usr/bin/env bash
# slides_test.sh SOURCE BIN: the slide checks find nothing wrong in this tree; in copies with one
# fault they fail, and name it. Plots are drawn by the program in BIN.
set -euo pipefail
source=$1 bin=$2
command -v node >/dev/null || { echo "node is missing: ./carlo setup --developer" && exit 77; }

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
tree=$scratch/tree

fresh_tree() {
  rm -rf "$tree"
  mkdir "$tree"
  cp -R "$source/slides" "$source/common" "$source/labs" "$source/README.md" "$tree/"
}

check() { node "$tree/slides/tool/slides.mjs" "${1:-check}" "$scratch/bin"; }

# expect WHAT PATTERN [MODE]: the tree in its current state fails with a matching line.
expect() {
  local code=0 text
  text=$(check "${3:-check}" 2>&1 >/dev/null) || code=$?
  if [ "$code" != 1 ] || ! grep -Eq "$2" <<<"$text"; then
    printf 'FAILED: %s: exit code %s\n%s\n' "$1" "$code" "$text"
    failures=$((failures + 1))
  fi
  fresh_tree
}

# first PATTERN FILE...: prints the first match, as "file:text".
first() {
  local pattern=$1 found
  shift
  found=$(cd "$tree" && grep -roE -m1 "$pattern" "$@" | sort | head -n 1)
  [ -n "$found" ] || { printf 'FAILED: nothing matches %s\n' "$pattern" >&2 && exit 1; }
  printf '%s' "$found"
}

fresh_tree
check >/dev/null || { echo "FAILED: the slides have errors" && exit 1; }

rm "$tree/labs/02_pi/picture.png"
expect "a lab without its picture" 'labs/02_pi/lab.json: has no picture'
sed -i 's/alt="64 points/alt="65 points/' "$tree/README.md"
expect "a picture described in other words" 'does not show labs/04_stratification/picture.png'

found=$(first '^<!-- eq: [a-z0-9-]+ -->' slides --include='0[1-8]*.md')
sed -i "s/${found#*:}/<!-- eq: renamed-by-a-test -->/" "$tree/${found%%:*}"
expect "a renamed label" 'label that no deck has|has the label'

found=$(first '\(slides [0-9]{2}:[a-z0-9-]+\)' labs --include=lab.json)
citation=${found#*:}
sed -i "s/$citation/(slides 01:there-is-none)/" "$tree/${found%%:*}"
expect "a citation of a label that does not exist" 'cites slides 01:there-is-none'

grep -rlE 'slides [0-9]{2}:' "$tree"/labs/04_* | xargs sed -Ei 's/slides [0-9]{2}:/slide /g'
expect "a lab that cites nothing: its exercises" 'Lab 4\.1 cites no slide'
grep -rlE 'slides [0-9]{2}:' "$tree"/labs/04_* | xargs sed -Ei 's/slides [0-9]{2}:/slide /g'
expect "a lab that cites nothing: its deck" 'nothing in labs/04_\* cites'

found=$(first '(//|#) slide: [a-z0-9-]+' common labs)
sed -i "s,${found#*:},// slide: renamed-by-a-test," "$tree/${found%%:*}"
expect "a renamed snippet" 'expected one line .// slide: '
expect_end=$(first '(//|#) end slide' common labs)
sed -i "s,^ *${expect_end#*:},," "$tree/${expect_end%%:*}"
expect "a snippet without end" "has no '// end slide'|has [0-9]+ lines"

found=$(first '"--solutions"' slides/figures)
sed -i 's/"--solutions"/"--frob"/' "$tree/${found%%:*}"
expect "a figure's command that is none" 'a command is \["lab"'
sed -i 's/"--solutions"/"--solutions", "--seed", "99"/' "$tree/${found%%:*}"
expect "a figure whose command was changed" 'was made by another command'

sed -i 's/"format": "percent"/"format": "furlongs"/' "$tree"/slides/figures/*.json
expect "a number in a unit that nobody knows" 'format must be one of percent, ns'

sed -i 's/"yscale": "log"/"yscale": "cubic"/' "$tree"/slides/figures/*.json
expect "an axis of an unknown kind" 'yscale must be one of log, linear'

figure=$(first 'figure:[a-z0-9-]+' slides --include='0*.md')
sed -i "s/(${figure#*:})/(figure:00-none)/" "$tree/${figure%%:*}"
expect "a figure that is not defined" 'no figure "00-none"'
sed -i 's/random points leave 24 empty/random points leave 25 empty/' "$tree"/labs/04_*/README.md
expect "a handout that says another number than the run" 'labs/04_stratification/README.md: does not say "random points leave 24 empty'
number=$(first '\{\{[0-9]{2}\.[a-z0-9.-]+\}\}' slides --include='0*.md')
sed -i "s/${number#*:}/{{01.none}}/" "$tree/${number%%:*}"
expect "a number that is not defined" 'no number \{\{01.none\}\}'

sed -i 's/| Four effects, four integrals |/| No such slide |/' "$tree/slides/lecture.md"
expect "a heading of the lecture without slide" 'has no slide "No such slide"'
sed -i 's/<!-- notes:/<!-- /' "$tree/slides/00_rendering_is_integration.md"
expect "slides without speaker notes" 'no speaker notes'
sed -i 's/^minutes: .*/minutes: 400/' "$tree/slides/00_rendering_is_integration.md"
expect "a deck without duration" 'minutes: N'

# Plots: round numbers at the axes' ends, names side by side, a square plot that is square.
node --input-type=module - "$source" "$bin" <<'END' || failures=$((failures + 1))
import assert from "node:assert";
const [source, bin] = process.argv.slice(2);
const { plotSvg } = await import(`${source}/slides/tool/plot.mjs`);
const { Runs } = await import(`${source}/slides/tool/runs.mjs`);
const runs = new Runs(source, bin);
const places = (svg, pattern) => [...svg.matchAll(pattern)].map(([, value]) => Number(value));
const named = (name, y, slope) => ({ name, points: [[16, 0.5], [64, NaN], [50000, y]], slope });

const loglog = plotSvg(runs, { kind: "loglog", xlabel: "N" }, "a < b", [named("one", 0.02, -0.5), named("<two>", 0.02)]);
assert.match(loglog, /aria-label="a &lt; b"/);
assert.match(loglog, />&lt;two&gt;<[^]*>one −0.50</);
assert.match(loglog, />10<\/text>[^]*>10<tspan[^>]*>5<\/tspan><\/text>/);
const [first, second] = places(loglog, /class="name[^>]* y="([^"]*)"/g);
assert(Math.abs(first - second) >= 14, "names overlap");

const square = plotSvg(runs, { kind: "points", square: true }, "", [named("", 70)]);
const [, left, top, bottom, right] = /class="axis" d="M([^ ]*) ([^V]*)V([^H]*)H([^"]*)"/.exec(square).map(Number);
assert(Math.abs(bottom - top - (right - left)) < 1.5, "the axes are no square");

const bars = plotSvg(runs, { kind: "bars", digits: 2 }, "", [{ name: "", points: [["a", 1], ["b", 4], ["c", NaN]] }]);
const [a, b, c] = places(bars, /<rect[^>]* width="([^"]*)"/g);
assert(Math.abs(b - 4 * a) < 0.5 && c === 0, "bars are as long as their values");
assert.throws(() => plotSvg(runs, { kind: "lines", yunit: "miles" }, "", []), /no axis counts in 'miles'/);
END

# Programs that fail, and programs that no longer provide what figures need.
mkdir "$scratch/bin"
for program in carlo_render lab0{1..8}_solution; do
  printf '#!/bin/sh\necho "out of order" >&2\nexit 3\n' >"$scratch/bin/$program"
  chmod +x "$scratch/bin/$program"
done
expect "commands that fail" 'failed \(exit code 3\): out of order' run
for program in "$scratch"/bin/lab0*; do
  cat >"$program" <<'END'
#!/bin/sh
while [ $# != 0 ]; do
  case $1 in
    --json) echo '{"tables": {"other": []}}' >"$2" ;;
    --page) echo '<html></html>' >"$2" ;;
  esac
  shift
done
END
done
expect "tables that are gone" 'the run has no table' run

[ "$failures" = 0 ]
