#!/usr/bin/env bash
# command_line_test.sh RENDERER SOURCE: what `./carlo render` does with bad input. Each broken scene
# and each bad argument gives one line on stderr, exit code 1, and no file.
set -euo pipefail
renderer=$1 source=$2
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/expect_error.sh"

# refused PATTERN ARGUMENTS...
refused() {
  local pattern=$1
  shift
  expect_error "$pattern" "$renderer" "$@"
}

count=0
for scene in "$source"/tests/common/broken_scenes/*.xml; do
  refused '^[^ ]+:[0-9]+:[0-9]+: error: ' "$scene"
  count=$((count + 1))
done
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
refused 'threads' "$good" --threads -2
refused 'NAME=VALUE' "$good" -D nonsense
refused 'bogus' "$good" -D bogus=1
refused 'sampler' "$good" --sampler best
refused 'missing.exr' "$good" --reference missing.exr
refused 'differ in size' "$good" --size 8x8 --spp 1 \
  --reference "$source/tests/references/peer_cornell_phong.exr"
refused 'frobnicate' "$good" --frobnicate

# And the good case: four files, a report, exit code 0.
(cd "$scratch" && "$renderer" "$good" --size 16x16 --spp 4 -o "$scratch/good" >stdout 2>stderr) ||
  complain "the good scene failed: $(cat "$scratch/stderr")"
for suffix in png exr error.png json; do
  [ -s "$scratch/good.$suffix" ] || complain "good.$suffix is missing"
done
grep -q 'standard error' "$scratch/stdout" || complain 'the report has no standard error'

# The film's size on the command line means the same as in the file, whatever side fov spans.
sed 's|<float name="fov" value="39.3077"/>|<float name="fov" value="30"/><string name="fovAxis" value="y"/>|' \
  "$good" >"$scratch/y.xml"
"$renderer" "$scratch/y.xml" --quiet --spp 2 -D width=32 -D height=16 -o "$scratch/file"
"$renderer" --quiet --spp 2 --size 32x16 -o "$scratch/argument" "$scratch/y.xml"
cmp -s "$scratch/file.png" "$scratch/argument.png" || complain '--size changes the field of view'

# A folder as output takes the scene's name.
mkdir "$scratch/folder"
"$renderer" "$good" --quiet --size 8x8 --spp 1 -o "$scratch/folder/"
[ -s "$scratch/folder/cornell_phong.png" ] || complain 'a folder as output'

# A disk that takes no more (here: files of at most 1 KiB) is noticed, and what was there stays.
cp -r "$scratch/folder" "$scratch/before"
code=0
(trap '' XFSZ && ulimit -f 1 &&
  "$renderer" "$good" --quiet --size 64x64 --spp 2 -o "$scratch/folder/") 2>"$scratch/stderr" || code=$?
[ "$code" = 1 ] || complain "exit code $code where no file can be written"
[ "$(wc -l <"$scratch/stderr")" = 1 ] || complain "full disk: $(cat "$scratch/stderr")"
diff -r "$scratch/folder" "$scratch/before" || complain 'a full disk changed older files'

printf '%d broken scenes tried\n' "$count"
finish
