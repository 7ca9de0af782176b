#!/usr/bin/env bash
# lab_render_test.sh SOLUTION STUB SOURCE: `./carlo render` with lab 8: the solution's program
# renders each kind of scene; the stub's program, and scenes that lab 8 does not support, give one
# line, exit code 1, and no file.
set -euo pipefail
solution=$1 stub=$2 scenes=$3/common/scenes
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/expect_error.sh"

# expect_image KERNEL ARGUMENTS...
expect_image() {
  local kernel=$1 suffix
  shift
  rm -rf "$scratch/image" && mkdir "$scratch/image"
  "$solution" "$@" --size 16x16 --spp 8 -o "$scratch/image/a" >"$scratch/stdout" ||
    complain "exit code $? for: $*"
  for suffix in png exr error.png json; do
    [ -s "$scratch/image/a.$suffix" ] || complain "a.$suffix is missing for: $*"
  done
  grep -q "kernel .*$kernel" "$scratch/stdout" || complain "not by $kernel: $*"
  grep -q '"bad_samples": 0' "$scratch/image/a.json" || complain "bad samples for: $*"
  # Lab 8 does not count its rays, so a report must not claim that there were none.
  grep -q '"rays": null' "$scratch/image/a.json" || complain "rays for: $*"
}

box=$scenes/cornell_phong.xml
expect_image 'Lab 8.8' "$box"
expect_image 'Lab 8.8' "$scenes/caustics.xml" --max-depth 5
expect_image 'Lab 8.4' "$box" --method recursive
expect_image 'Lab 8.7' "$scenes/caustics.xml" --method direct

expect_error 'Lab 8\.8 is not implemented yet: run ./carlo hint 8.8' "$stub" "$box" --spp 4
expect_error 'Lab 8\.4 is not implemented yet: run ./carlo hint 8.4' "$stub" "$box" --method recursive
expect_error 'Lab 8\.7 is not implemented yet: run ./carlo hint 8.7' "$stub" "$box" --method direct
expect_error 'does not support mirrors or glass' "$solution" "$scenes/caustics.xml" --method recursive
expect_error 'end after 4 segments' "$solution" "$box" --max-depth 4 --method direct
expect_error 'method' "$solution" "$box" --method best
# Stopping at a target, resuming and sharding are the reference renderer's alone.
for option in target-error=.1 resume=a.exr shard=1/2 slurm; do
  expect_error "there is no option --${option%%=*}" "$solution" "$box" "--$option"
done
expect_error 'no_such.xml' "$solution" no_such.xml

cat >"$scratch/point.xml" <<'XML'
<scene version="0.6.0">
  <sensor type="perspective"><float name="fov" value="40"/></sensor>
  <shape type="sphere"/>
  <emitter type="point"><rgb name="intensity" value="1"/></emitter>
</scene>
XML
expect_error 'does not support point lights' "$solution" "$scratch/point.xml"
expect_error 'does not support environment maps' "$solution" "$scenes/image_light.xml"

finish
