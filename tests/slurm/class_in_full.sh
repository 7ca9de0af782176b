#!/usr/bin/env bash
# class_in_full.sh SOURCE BUILD WORK [RUNS [RIGHT MISTAKEN ATTACKS]]: a class of 200 (right answers
# of all labs, typical mistakes, attacks) on this machine, and RUNS (10) times as an array over four
# nodes, while tasks are killed, nodes lose power and come back, and two processes wait for the same
# class. Each class.csv must equal this machine's, byte for byte. Does not remake what exists in
# WORK.
set -euo pipefail
source=$(readlink -f "$1") build=$(readlink -f "$2") work=$3 runs=${4:-10}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# grade OUT OPTION...
grade() {
  local out=$1
  shift
  "$build/bin/carlo_grade" --tree "$source" --build "$build" class --secret-file secret -o "$out" "$@"
}

# disturb OUT TIMES: every few seconds kills a task or a node, and restores what was down; finally
# stops killing, so that the last tasks can end.
disturb() {
  local node task running=() down='' times=$2
  while :; do
    sleep $((RANDOM % 20 + 5))
    if [ -n "$down" ]; then
      "$CARLO_CLUSTER" up "$down" 2>/dev/null
      down=''
    fi
    "$CARLO_CLUSTER" hurry
    ((times-- > 0)) || continue
    node=node$((RANDOM % 4 + 1))
    case $((RANDOM % 3)) in
      0)
        "$CARLO_CLUSTER" crash "$node" || continue
        scontrol update NodeName="$node" State=DOWN Reason=power
        down=$node
        printf 'power %s\n' "$node" ;;
      1)
        "$CARLO_CLUSTER" on "$node" bash -c "kill -KILL \$(pgrep -f -- '--task $PWD/' | shuf -n 1)" 2>/dev/null || continue
        printf 'killed on %s\n' "$node" ;;
      2)
        mapfile -t running < <(squeue --noheader --array --states RUNNING --format %F_%K)
        [ ${#running[@]} != 0 ] || continue
        task=${running[RANDOM % ${#running[@]}]}
        scontrol requeue "$task" || continue
        printf 'requeued %s\n' "$task" ;;
    esac
  done >>"$1.disturbed" 2>/dev/null
}

# cluster RUN
cluster() {
  local out=run_$1 tries code=0 noise other
  RANDOM=$1
  disturb "$out" 24 &
  noise=$!
  # If an array made no progress, repeats the command as a user would.
  for ((tries = 1; tries <= 20; ++tries)); do
    code=0
    grade "$out" --slurm --tasks 24 >>"$out.other.log" 2>&1 &
    other=$!
    grade "$out" --slurm --tasks 24 >>"$out.log" 2>&1 || code=$?
    wait "$other" || true
    [ "$code" != 0 ] || break
  done
  kill "$noise" 2>/dev/null || true
  wait "$noise" 2>/dev/null || true
  [ "$code" = 0 ] || fail "$out: not done after $tries times: $(tail -n 3 "$out.log")"
  cmp whole/class.csv "$out/class.csv" || fail "$out/class.csv is not this machine's"
  printf 'run %s: the same class.csv; %s tasks killed, %s requeued, %s nodes lost; typed %s times, %s arrays\n' "$1" \
    "$(grep -c ^killed "$out.disturbed")" "$(grep -c ^requeued "$out.disturbed")" "$(grep -c ^power "$out.disturbed")" \
    "$tries" "$(cat "$out.log" "$out.other.log" | grep -c '^job [0-9]*: .* tasks for')"
}

if [ "${5:-}" = inside ]; then
  cluster "$4"
  exit
fi
"$here/cluster.sh" run --nodes 1 true || exit
[ -e "$work/made" ] || "$here/make_class.sh" "$source" "$build" "$work" "${5:-60}" "${6:-100}" "${7:-39}"
chmod 711 "$work"
cd "$work"
touch made
[ -e secret ] || echo 'a secret of this test' >secret
begun=$SECONDS
grade whole -j 2 >whole.log 2>&1 || fail "this machine's grader ended with $?: $(tail -n 3 whole.log)"
printf 'one machine: %s submissions in %s s\n' "$(find class -mindepth 1 -maxdepth 1 | wc -l)" "$((SECONDS - begun))"
for ((run = 1; run <= runs; ++run)); do
  begun=$SECONDS
  rm -rf "run_$run" "run_$run".*
  "$here/cluster.sh" run "$here/class_in_full.sh" "$source" "$build" . "$run" inside
  printf '  in %s s\n' "$((SECONDS - begun))"
done
