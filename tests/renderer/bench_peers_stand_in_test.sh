#!/usr/bin/env bash
# bench_peers_stand_in_test.sh BENCH SOURCE RENDER: the part `peers` of `./carlo bench` with our own
# renderer in place of a Python that has only Mitsuba: an image of the same scene counts, one of
# another scene does not, a failing integrator gets a line, and missing renderers are reported.
set -euo pipefail
bench=$1 source=$2 render=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/references"
cp "$source/tests/references/scenes/"{cornell_lambert,cornell_phong,furnace}.exr "$scratch/references"

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# Renders a Cornell box, whatever is requested.
cat >"$scratch/python" <<EOF
#!/usr/bin/env bash
set -e
if [ "\$1" = -c ]; then
  [ "\$2" = 'import mitsuba' ] && exit 0
  exit 1
fi
case \$1 in "$scratch"/*/mitsuba_peer.py) ;; *) echo "Error: \$1"; exit 1 ;; esac
input=\${*: -1}
! grep -q ptracer "\$input" || { echo 'RuntimeError: no particles'; exit 3; }
seed=\$(grep -o '"seed":[0-9]*' "\$input")
output=\$(grep -o '"output":"[^"]*"' "\$input" | cut -d '"' -f 4)
"$render" "$source/common/scenes/cornell_lambert.xml" --size 128x128 --spp 64 --sampler independent \\
  --seed "\${seed#*:}" -o "\${output%.exr}" >"$scratch/render.log"
printf '\ncarlo: {"seconds": 2.0, "version": "stand-in"}\n'
EOF
chmod +x "$scratch/python"
mkdir "$scratch/scripts"

# run PYTHON: writes its table to $scratch/out.
run() {
  "$bench" --scenes "$source/common/scenes" --references "$scratch/references" --scratch "$scratch" \
    --only peers --peers "$scratch/$1" --peer-scripts "$scratch/scripts" --seed 31 \
    --page "$scratch/page/page.html" >"$scratch/out" 2>"$scratch/stderr" ||
    fail "exit code $? with $1: $(cat "$scratch/out" "$scratch/stderr")"
}

run python
json=$scratch/page/page.json
grep -q 'Mitsuba 3 has no exact equal of: cornell_phong' "$scratch/page/page.html" || fail 'who is left out?'
grep -q 'cornell_lambert, Mitsuba 3 ptracer: .*RuntimeError: no particles' "$scratch/out" || fail "$(cat "$scratch/out")"
grep -q 'LuxCore is not installed' "$scratch/out" || fail 'what is not installed is not said'
grep -q 'Cycles is not installed' "$scratch/out" || fail 'what is not installed is not said'
grep -q 'no: the image differs' "$json" || fail 'a furnace that is a Cornell box counts'
best=$(sed -n '/"best_peers"/,/]/p' "$json")
grep -q cornell_lambert <<<"$best" || fail "the best peer has no row: $best"
! grep -q furnace <<<"$best" || fail 'another image is the best'

run missing
grep -q 'Mitsuba 3 is not installed' "$scratch/out" || fail "$(cat "$scratch/out")"
