#!/usr/bin/env bash
# cluster_test.sh: the cluster for other tests (cluster.sh) can be killed, its nodes fail and come
# back, and another can run beside it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

inside() {
  local job nodes
  nodes=$(srun --nodes 2 hostname | sort | paste -sd' ')
  [ "$nodes" = 'node1 node2' ] || fail "it ran on: $nodes"
  # shellcheck disable=SC2016 # expanded on the node
  job=$(sbatch --parsable --nodelist node2 --output "$PWD/log" --open-mode append --wrap \
    'echo "run ${SLURM_RESTART_COUNT:-0} on $(hostname)"; [ -n "$SLURM_RESTART_COUNT" ] || sleep 1000')
  until [ -s log ]; do sleep .1; done
  "$CARLO_CLUSTER" crash node2
  [ -z "$(ps -C sleep -o pid=)" ] || fail 'the node crashed, and its job runs'
  scontrol update NodeName=node2 State=DOWN Reason=power
  until squeue --noheader --job "$job" --states PENDING --format %r | grep -q .; do sleep .1; done
  "$CARLO_CLUSTER" up node2
  "$CARLO_CLUSTER" hurry
  "$CARLO_CLUSTER" settled
  [ "$(paste -sd, log)" = 'run 0 on node2,run 1 on node2' ] || fail "of a requeued job: $(cat log)"
}

case ${1:-} in
  inside) inside && exit ;;
  waiting) srun --nodes 2 bash -c 'touch running && exec sleep 1234' && exit ;;
esac

temporary=$(mktemp -d)
trap 'kill -KILL $(jobs -p) 2>/dev/null || true; rm -rf "$temporary"' EXIT
cd "$temporary"
"$here/cluster.sh" run --nodes 1 true || exit
mkdir other
(cd other && exec "$here/cluster.sh" run --nodes 2 "$here/cluster_test.sh" waiting) >other/log 2>&1 &
"$here/cluster.sh" run --nodes 2 "$here/cluster_test.sh" inside
until [ -e other/running ]; do sleep .1; done
# Processes of the other cluster, seen from outside.
space=$(readlink "/proc/$(cat "/proc/$!/task/$!/children" | tr -d ' ')/ns/pid")
processes() { find /proc/[0-9]*/ns/pid -printf '%l\n' 2>/dev/null | grep -cxF "$space"; }
[ "$(processes)" -gt 3 ] || fail 'the other cluster has no processes'
kill -KILL $!
for ((tries = 0; $(processes) != 0; ++tries)); do
  ((tries < 300)) || fail 'the cluster was killed, and its processes live on'
  sleep .1
done
