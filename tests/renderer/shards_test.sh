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
shard 1/2 -o folder && [ -s folder/cornell_phong.1-of-2.exr ] || complain 'a folder as output'
(shard 1/2 && [ -s out/cornell_phong.1-of-2.exr ]) || complain 'no output given'

# The same command resumes a killed shard; a finished one has nothing to do.
long() { "$renderer" "$box" --quiet --size 64x64 --spp 4096 --threads 1 --shard 2/3 "$@"; }
long -o undisturbed
for signal in KILL INT; do
  (exec "$renderer" "$box" --quiet --size 64x64 --spp 4096 --threads 1 --shard 2/3 --checkpoint .1 \
    -o killed$signal) &
  pid=$!
  for _ in $(seq 6000); do
    [ ! -s killed$signal.exr ] || break
    sleep .05
  done
  kill -$signal $pid
  code=0
  wait $pid 2>/dev/null || code=$?
  [ $signal != INT ] || [ $code = 130 ] || complain "exit code $code after Ctrl-C"
  expect_error 'samples \(shards 1/3, 2/3 in part, 3/3\) are missing' "$merge" "$scratch/killed$signal.exr"
  expect_error 'its seed is 1, this render.s 8; remove it' "$renderer" "$box" --size 64x64 --spp 4096 --shard 2/3 \
    --seed 8 -o "$scratch/killed$signal"
  long -o killed$signal || complain "no way to go on after SIG$signal"
  for of in "a killed$signal" "b undisturbed"; do "$merge" --quiet --partial --no-sums "${of#* }.exr" -o "${of%% *}"; done
  cmp a.exr b.exr || complain "a shard that got SIG$signal and went on has other bits"
done
cp killedINT.exr before.exr
long -o killedINT
cmp killedINT.exr before.exr || complain 'a finished shard was written again'

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
shard_refused 'cannot go on with .*whole.exr: it is no part of a render; remove it' --shard 1/2 -o "$scratch/whole"

# merge_refused PATTERN ARGUMENTS...
merge_refused() {
  local pattern=$1
  shift
  expect_error "$pattern" "$merge" "$@"
}
one=$scratch/one.exr two=$scratch/two.exr
merge_refused 'parts is missing'
merge_refused 'no such file' "$one" no_such.exr
merge_refused 'cannot merge .*whole.exr: it is no part' "$one" "$scratch/whole.exr"
merge_refused 'one.exr is given twice' "$one" "$two" "$one"
merge_refused '^error: 50 % of the samples \(shards 2/2\) are missing; --partial' "$one"
merge_refused 'cannot write .*: ' "$one" "$two" -o no/such/folder/image
merge_refused 'missing.exr' "$one" "$two" --reference missing.exr
merge_refused 'differ in size' "$one" "$two" --reference "$scratch/whole.exr"
# other PATTERN SCENE SIZE SPP ARGUMENTS...: the second half of another render.
other() {
  rm -f other.exr
  "$renderer" "$2" --quiet --size "$3" --spp "$4" --shard 2/2 -o other "${@:5}"
  merge_refused "other.exr is of another render than .*one.exr: its $1" "$one" "$scratch/other.exr"
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
head -c 20000 "$two" >short.exr
merge_refused 'cannot read .*short.exr' "$one" "$scratch/short.exr"
head -c 500 "$two" >short.exr
merge_refused 'short.exr: it is cut short' "$one" "$scratch/short.exr"
cp "$two" spoilt.exr && printf 'x' | dd of=spoilt.exr bs=1 seek=20000 conv=notrunc status=none
merge_refused 'cannot read .*spoilt.exr' "$one" "$scratch/spoilt.exr"
sed 's/"microseconds":"[0-9]/"microseconds":"x/' "$two" >spoilt.exr
merge_refused 'spoilt.exr: ' "$one" "$scratch/spoilt.exr"
sed 's/"parts":"1"/"parts":"2"/' "$two" >spoilt.exr
merge_refused 'spoilt.exr: it is spoilt' "$one" "$scratch/spoilt.exr"

# What is there, on request: no part of it passes for the whole, and the rest may come later.
"$merge" "$one" --partial -o half >stdout
grep -q '50 % of the samples are there' stdout || complain 'the report does not say that half is missing'
grep -q '"share": 0.5' half.json || complain 'the JSON report has no share'
expect_error 'it is shard 1/2 of a render; ./carlo merge adds the rest' "$renderer" --resume "$scratch/half.exr" --spp 128
"$renderer" "$box" --quiet --size 32x32 --spp 64 -o all
"$merge" --quiet half.exr two.exr -o both && cmp all.exr both.exr || complain 'a half and the rest are not the whole'

# A disk that takes no more (here: files of at most 1 KiB) is noticed, and what was there stays.
cp two.exr before.exr
full_disk() {
  local code=0
  (trap '' XFSZ && ulimit -f 1 && "$@") 2>stderr || code=$?
  [ "$code" = 1 ] || complain "exit code $code on a full disk: $*"
  grep -q 'disk full\|cannot write' stderr || complain "full disk: $(cat stderr)"
}
full_disk "$merge" --quiet one.exr two.exr -o two
full_disk "$merge" --quiet one.exr two.exr -o half
full_disk "$renderer" "$box" --quiet --size 32x32 --spp 64 --shard 2/2 -o three
cmp two.exr before.exr || complain 'a full disk changed an older part'
[ ! -e three.exr ] || complain 'a full disk left half a part'
finish
