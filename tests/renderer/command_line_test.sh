#!/usr/bin/env bash
# command_line_test.sh RENDERER TEST_FILES SOURCE [EVERY]: what `./carlo render` does with bad input. Each bad
# argument gives one line on stderr, exit code 1, and no file; so does each broken scene, a line for each
# mistake. Every tenth (EVERY-th) of them is tried here: what their lines say is tested for all, without
# starting a program (tests/common/scene_errors_test.cpp).
set -euo pipefail
renderer=$1 test_files=$2 source=$3 every=${4:-10}
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/expect_error.sh"

# refused PATTERN ARGUMENTS...
refused() {
  local pattern=$1
  shift
  expect_error "$pattern" "$renderer" "$@"
}

count=0
while read -r mistakes scene; do
  [ $((count % every)) != 0 ] || lines=$mistakes refused '^[^ ]+:[0-9]+:[0-9]+: error: ' "$scratch/scenes/$scene"
  count=$((count + 1))
done < <("$test_files" "$source/tests/common/broken_scenes" "$scratch/scenes" | sort -k 2)
[ "$count" -ge 20 ] || complain "only $count broken scenes"

good=$source/common/scenes/cornell_phong.xml
refused 'no_such.xml' no_such.xml
refused 'error: .*folder' "$source"
refused 'cannot write .*: ' "$good" -o no/such/folder/image
refused 'WIDTHxHEIGHT' "$good" --size 12
refused 'WIDTHxHEIGHT' "$good" --size 12xtwelve
refused '0x0' "$good" --size 0x0
refused '33554432' "$good" --size 100000x100000 --spp 1
refused 'spp' "$good" --spp 0
refused 'spp' "$good" --spp many
refused 'seconds' "$good" --spp 4 --seconds 3
for target in 0 -.1 nan inf 1 all; do
  refused 'target-error' "$good" "--target-error=$target" --size 8x8
done
refused '32 samples' "$good" --target-error .1 --spp 31 --size 8x8
refused 'threads' "$good" --threads -2
refused 'NAME=VALUE' "$good" -D nonsense
refused 'bogus' "$good" -D bogus=1
refused 'sampler' "$good" --sampler best
refused 'missing.exr' "$good" --reference missing.exr
refused 'peer_cornell_phong.exr has 256 x 256 pixels, expected those of the film, 8 x 8' "$good" --size 8x8 \
  --spp 1 --reference "$source/tests/references/peer_cornell_phong.exr"
refused 'nan.exr has B nan in column 2, row 2, expected finite radiances' "$good" --size 4x2 --spp 1 \
  --reference "$scratch/scenes/parts/nan.exr"
refused 'frobnicate' "$good" --frobnicate
refused 'ends in .html, got .page.txt' "$good" --page page.txt
refused 'cannot write .*: ' "$good" --page no/such/folder/page.html

# The good case: four files, a report, exit code 0.
(cd "$scratch" && "$renderer" "$good" --size 16x16 --spp 4 -o "$scratch/good" >stdout 2>stderr) ||
  complain "the good scene failed: $(cat "$scratch/stderr")"
for suffix in png exr error.png json; do
  [ -s "$scratch/good.$suffix" ] || complain "good.$suffix is missing"
done
grep -q 'standard error' "$scratch/stdout" || complain 'the report has no standard error'

# With a target: also a map of where the samples went, and the result.
"$renderer" "$good" --size 16x16 --target-error .3 --spp 512 -o "$scratch/target" >"$scratch/stdout" ||
  complain '--target-error failed'
[ -s "$scratch/target.samples.png" ] || complain 'target.samples.png is missing'
grep -q '"reached"' "$scratch/target.json" || complain 'the JSON report has no share of pixels'
grep -q 'within it are' "$scratch/stdout" || complain 'the report has no share of pixels'

# start_long NAME ARGUMENTS...: starts a long render, $long, and waits for its first checkpoint.
start_long() {
  (cd "$scratch" &&
    exec "$renderer" "$good" --quiet --size 32x32 --seed 9 --checkpoint .2 -o "$1" "${@:2}") &
  long=$!
  # Waits however slow the machine is.
  while kill -0 "$long" 2>/dev/null; do
    [ ! -s "$scratch/$1.json" ] || return 0
    sleep .1
  done
  complain "$1 ended without a checkpoint"
}

# Which renders can be resumed, and which not (tests/renderer/production/resume_test.cpp compares the bits).
"$renderer" "$good" --quiet --size 32x32 --spp 64 --seed 9 -o "$scratch/whole"
start_long part --spp 4194304
kill -INT "$long"
code=0
wait "$long" || code=$?
[ "$code" = 130 ] || complain "exit code $code after Ctrl-C"
refused 'multiple of 64' --resume "$scratch/part.exr" --spp 70
refused 'seed is 9' --resume "$scratch/part.exr" --spp 4194304 --seed 8
refused 'kernel is' --resume "$scratch/part.exr" --spp 4194304 --kernel scalar
refused 'scene or the film' "$good" --resume "$scratch/part.exr" --spp 4194304 --size 8x8
refused 'which' --resume "$scratch/part.exr"
refused 'target' --resume "$scratch/part.exr" --target-error .1
refused 'not the sums' --resume "$source/tests/references/peer_cornell_phong.exr" --spp 128
refused 'missing.exr' --resume missing.exr --spp 128
head -c 3000 "$scratch/whole.exr" >"$scratch/short.exr"
refused 'cannot read .*short.exr' --resume "$scratch/short.exr" --spp 128
"$renderer" "$good" --quiet --size 32x32 --spp 64 --seed 9 --no-sums -o "$scratch/small"
refused 'not the sums' --resume "$scratch/small.exr" --spp 128

# A checkpoint survives a kill that cannot be caught.
start_long killed --spp 4194304
kill -KILL "$long"
wait "$long" 2>/dev/null || true
"$renderer" --quiet --resume "$scratch/killed.exr" --seconds .1 || complain 'no way to go on after SIGKILL'
[ -s "$scratch/killed.png" ] || complain 'the resumed render did not go to the same place'

# With a target, too, and it ends as if nothing had happened. One thread: a few seconds.
target=(--threads 1 --target-error .01 --spp 8192)
"$renderer" "$good" --quiet --size 32x32 --seed 9 -o "$scratch/undisturbed" "${target[@]}"
start_long target_killed "${target[@]}"
kill -KILL "$long"
wait "$long" 2>/dev/null || true
[ ! -e "$scratch/target_killed.png" ] || complain 'the render with a target ended before it was killed'
refused 'target error is 0.01' --resume "$scratch/target_killed.exr" --target-error .02
refused 'seed is 9' --resume "$scratch/target_killed.exr" --seed 8
refused 'cannot continue with --spp 32' --resume "$scratch/target_killed.exr" --spp 32
"$renderer" --quiet --resume "$scratch/target_killed.exr" || complain 'no way to go on to a target'
cmp "$scratch/undisturbed.exr" "$scratch/target_killed.exr" ||
  complain 'a render with a target that was killed and resumed has other bits'

# A page on demand: beside the image, or where the option says. A scene may follow the option.
[ ! -e "$scratch/good.html" ] || complain 'a page that nobody asked for'
"$renderer" --quiet --size 16x16 --spp 4 -o "$scratch/good" --page "$good"
grep -q 'class="viewer"' "$scratch/good.html" || complain 'the page has no viewer'
grep -q "./carlo render --quiet --size 16x16" "$scratch/good.html" || complain 'the page has no command'
"$renderer" "$good" --quiet --size 16x16 --spp 4 -o "$scratch/other" --page "$scratch/page.html" \
  --reference "$scratch/good.exr"
# A reference that states no standard errors counts as exact, and the report says so.
"$renderer" "$good" --size 256x256 --spp 1 -o "$scratch/other" \
  --reference "$source/tests/references/peer_cornell_phong.exr" >"$scratch/said"
grep -q 'the reference has no channels se.R, se.G, se.B' "$scratch/said" || complain 'a reference without errors: not a word'
"$renderer" "$good" --size 16x16 --spp 4 -o "$scratch/other" --reference "$scratch/good.exr" >"$scratch/said"
! grep -q 'the reference has no' "$scratch/said" || complain "$(cat "$scratch/said")"
grep -q '<dt>FLIP</dt>' "$scratch/page.html" || complain 'the page has no FLIP'
[ ! -e "$scratch/other.html" ] || complain 'two pages'

# The film's size on the command line means the same as in the file, whichever side fov spans.
sed 's|<float name="fov" value="39.3077"/>|<float name="fov" value="30"/><string name="fovAxis" value="y"/>|' \
  "$good" >"$scratch/y.xml"
"$renderer" "$scratch/y.xml" --quiet --spp 2 -D width=32 -D height=16 -o "$scratch/file"
"$renderer" --quiet --spp 2 --size 32x16 -o "$scratch/argument" "$scratch/y.xml"
cmp -s "$scratch/file.png" "$scratch/argument.png" || complain '--size changes the field of view'

# A folder as output takes the scene's name.
mkdir "$scratch/folder"
"$renderer" "$good" --quiet --size 8x8 --spp 1 -o "$scratch/folder/"
[ -s "$scratch/folder/cornell_phong.png" ] || complain 'a folder as output'

# A full disk (here: files of at most 1 KiB) is noticed, and the previous file stays.
cp -r "$scratch/folder" "$scratch/before"
code=0
(trap '' XFSZ && ulimit -f 1 &&
  "$renderer" "$good" --quiet --size 64x64 --spp 2 -o "$scratch/folder/") 2>"$scratch/stderr" || code=$?
[ "$code" = 1 ] || complain "exit code $code where no file can be written"
[ "$(wc -l <"$scratch/stderr")" = 1 ] || complain "full disk: $(cat "$scratch/stderr")"
diff -r "$scratch/folder" "$scratch/before" || complain 'a full disk changed older files'

# An error that cannot be printed is still one.
for nowhere in '2>&-' '2>/dev/full'; do
  code=0
  (eval "\"\$renderer\" nothing.xml $nowhere") || code=$?
  [ "$code" = 1 ] || complain "exit code $code with $nowhere"
done

printf '%d broken scenes tried\n' "$count"
finish
