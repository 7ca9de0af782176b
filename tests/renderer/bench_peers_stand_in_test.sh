#!/usr/bin/env bash
# bench_peers_stand_in_test.sh BENCH SOURCE RENDER: the part `peers` of `./carlo bench` with our own
# renderer in place of a Python that has only Mitsuba: an image of the same scene counts, one of
# another scene does not, a failing integrator gets a line, and missing renderers are reported. What an
# interrupted run has measured is not measured again.
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
printf '%s %s\n' "\$seed" "\$(grep -o '"variant":"[^"]*"' "\$input")" >>"$scratch/renders"
"$render" "$source/common/scenes/cornell_lambert.xml" --size 128x128 --spp 64 --sampler independent \\
  --seed "\${seed#*:}" -o "\${output%.exr}" >"$scratch/render.log"
printf '\ncarlo: {"seconds": 2.0, "version": "stand-in"}\n'
EOF
chmod +x "$scratch/python"
mkdir "$scratch/scripts"

command=("$bench" --scenes "$source/common/scenes" --references "$scratch/references" --scratch "$scratch"
  --only peers --peer-scripts "$scratch/scripts" --seed 31 --page "$scratch/page/page.html" --peers)

# run PYTHON: writes its table to $scratch/out.
run() {
  "${command[@]}" "$scratch/$1" >"$scratch/out" 2>"$scratch/stderr" ||
    fail "exit code $? with $1: $(cat "$scratch/out" "$scratch/stderr")"
}

# Interrupted once something is finished.
"${command[@]}" "$scratch/python" >"$scratch/out" 2>"$scratch/stderr" &
for _ in $(seq 600); do
  [ ! -e "$scratch/page/page.partial.json" ] || break
  sleep .1
done
kill -INT $!
! wait $! || fail 'an interrupted run says that all went well'
grep -q 'interrupted; the same command continues from here' "$scratch/stderr" ||
  fail "$(cat "$scratch/stderr")"
run python
grep -q "^an interrupted run's measurements are taken from" "$scratch/out" || fail 'nothing is continued'
[ "$(head -n 3 "$scratch/renders" | sort -u | wc -l)" = 3 ] || fail "$(cat "$scratch/renders")"
[ "$(grep -c '"seed":31 "variant":"scalar_rgb"' "$scratch/renders")" = 2 ] ||
  fail "measured again, not once for each scene: $(cat "$scratch/renders")"
[ ! -e "$scratch/page/page.partial.json" ] || fail 'the file of unfinished runs is still there'
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
