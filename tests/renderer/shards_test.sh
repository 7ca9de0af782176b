#!/usr/bin/env bash
# shards_test.sh RENDERER MERGE SOURCE: `./carlo render --shard` and `./carlo merge` as programs:
# killed shards, refusals, and that these leave nothing behind. The bits: merge_test.sh. Refused
# settings and damaged bytes: tests/renderer/production/part_test.cpp.
set -euo pipefail
renderer=$1 merge=$2 source=$3
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/expect_error.sh"
cd "$scratch"
box=$source/common/scenes/cornell_phong.xml

"$renderer" "$box" --quiet --size 24x40 --spp 24 -o whole

# shard I/N [ARGUMENTS...]: a shard of a small render.
shard() { "$renderer" "$box" --quiet --size 32x32 --spp 64 --shard "$@"; }
shard 1/2 -o one && shard 2/2 -o two

# By default the name contains the shard, also in a folder.
mkdir folder
shard 1/2 -o folder && [ -s folder/cornell_phong.1-of-2.part ] || complain 'a folder as output'
(shard 1/2 && [ -s out/cornell_phong.1-of-2.part ]) || complain 'no output given'

# The same command resumes a killed shard; a finished one has nothing to do.
long() { "$renderer" "$box" --quiet --size 64x64 --spp 4096 --threads 1 --shard 2/3 "$@"; }
long -o undisturbed
for signal in KILL INT; do
  (exec "$renderer" "$box" --quiet --size 64x64 --spp 4096 --threads 1 --shard 2/3 --checkpoint .1 \
    -o killed$signal) &
  pid=$!
  for _ in $(seq 6000); do
    [ ! -s killed$signal.part ] || break
    sleep .05
  done
  kill -$signal $pid
  code=0
  wait $pid 2>/dev/null || code=$?
  [ $signal != INT ] || [ $code = 130 ] || complain "exit code $code after Ctrl-C"
  expect_error 'samples \(shards 1/3, 2/3 in part, 3/3\) are missing' "$merge" "$scratch/killed$signal.part"
  expect_error 'its seed is 1, this render.s 8; remove it' "$renderer" "$box" --size 64x64 --spp 4096 --shard 2/3 \
    --seed 8 -o "$scratch/killed$signal"
  long -o killed$signal || complain "no way to go on after SIG$signal"
  "$merge" --quiet --partial killed$signal.part -o a && "$merge" --quiet --partial undisturbed.part -o b
  cmp a.exr b.exr || complain "a shard that got SIG$signal and went on has other bits"
done
cp killedINT.part before.part
long -o killedINT
cmp killedINT.part before.part || complain 'a finished shard was written again'

# Parts of other renders, and existing names.
shard_refused() {
  local pattern=$1
  shift
  expect_error "$pattern" "$renderer" "$box" --size 32x32 --spp 64 "$@"
}
for wrong in '' 3 0/2 3/2 -1/2 1/2/3 1/9999999 a/b; do
  shard_refused 'shard' "--shard=$wrong"
done
shard_refused 'shard does not go with --seconds' --shard 1/2 --seconds 1
shard_refused 'shard does not go with --target-error' --shard 1/2 --target-error .1
shard_refused 'shard does not go with --resume' --shard 1/2 --resume "$scratch/whole.exr"
shard_refused 'shard does not go with --no-sums' --shard 1/2 --no-sums
shard_refused 'shard does not go with --reference' --shard 1/2 --reference "$scratch/whole.exr"
shard_refused 'shard does not go with --page' --shard 1/2 --page
shard_refused 'cannot write .*: ' --shard 1/2 -o no/such/folder/part
shard_refused 'it is shard 1/2, not shard 2/2; remove it' --shard 2/2 -o "$scratch/one"
shard_refused 'its sampler is ' --shard 1/2 --sampler independent -o "$scratch/one"
cp whole.exr taken.part
shard_refused 'cannot read .*taken.part: it is no part' --shard 1/2 -o "$scratch/taken"

# merge_refused PATTERN ARGUMENTS...
merge_refused() {
  local pattern=$1
  shift
  expect_error "$pattern" "$merge" "$@"
}
one=$scratch/one.part two=$scratch/two.part
merge_refused 'parts is missing'
merge_refused 'no such file' "$one" no_such.part
merge_refused 'it is no part' "$one" "$scratch/whole.exr"
merge_refused 'one.part is given twice' "$one" "$two" "$one"
merge_refused '^error: 50 % of the samples \(shards 2/2\) are missing; --partial' "$one"
merge_refused 'cannot write .*: ' "$one" "$two" -o no/such/folder/image
merge_refused 'missing.exr' "$one" "$two" --reference missing.exr
merge_refused 'expected those of the film' "$one" "$two" --reference "$scratch/whole.exr"
merge_refused 'are for images' "$one" --partial -o "$scratch/x.part"
# other PATTERN SCENE SIZE SPP ARGUMENTS...: the second half of another render.
other() {
  rm -f other.part
  "$renderer" "$2" --quiet --size "$3" --spp "$4" --shard 2/2 -o other "${@:5}"
  merge_refused "other.part is of another render than .*one.part: its $1" "$one" "$scratch/other.part"
}
sed 's/fov" value="[0-9.]*"/fov" value="40"/' "$box" >wider.xml
other 'seed is 2, the other.s 1' "$box" 32x32 64 --seed 2
other 'film is 32 x 48' "$box" 32x48 64
other 'sampler is independent, the other.s sobol' "$box" 32x32 64 --sampler independent
other 'max_depth is 3' "$box" 32x32 64 --max-depth 3
other 'scene is ' wider.xml 32x32 64
other 'planned_spp is 128' "$box" 32x32 128
other 'kernel is scalar' "$box" 32x32 64 --kernel scalar
cp "$renderer" another_program && printf ' ' >>another_program
this=$renderer renderer=$scratch/another_program
other 'version is ' "$box" 32x32 64
renderer=$this
head -c 5000 "$two" >short.part
merge_refused 'short.part: it is cut short' "$one" "$scratch/short.part"
cp "$two" spoilt.part && printf 'x' | dd of=spoilt.part bs=1 seek=5000 conv=notrunc status=none
merge_refused 'spoilt.part: corrupt' "$one" "$scratch/spoilt.part"

# Merges an incomplete set on request; no part of it passes for the whole.
"$merge" "$one" --partial -o half >stdout
grep -q '50 % of the samples are there' stdout || complain 'the report does not say that half is missing'
grep -q '"share": 0.5' half.json || complain 'the JSON report has no share'
expect_error 'not the sums' "$renderer" --resume "$scratch/half.exr" --spp 128

# A full disk (here: files of at most 1 KiB) is noticed, and the previous file stays.
cp two.part before.part
full_disk() {
  local code=0
  (trap '' XFSZ && ulimit -f 1 && "$@") 2>stderr || code=$?
  [ "$code" = 1 ] || complain "exit code $code on a full disk: $*"
  grep -q 'disk full\|cannot write' stderr || complain "full disk: $(cat stderr)"
}
full_disk "$merge" --quiet one.part two.part -o two.part
full_disk "$merge" --quiet one.part two.part -o half
full_disk "$renderer" "$box" --quiet --size 32x32 --spp 64 --shard 2/2 -o three
cmp two.part before.part || complain 'a full disk changed an older part'
[ ! -e three.part ] || complain 'a full disk left half a part'
finish
