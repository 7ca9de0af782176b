#!/usr/bin/env bash
# Runs a real Slurm on one machine, for tests and for trying things by hand.
#
#   cluster.sh run [--nodes N] [--cpus C] COMMAND...   starts it, runs COMMAND and stops everything; the exit
#                                                      code is COMMAND's, or 77 with the reason if Slurm is
#                                                      missing (1 if CARLO_SLURM_TESTS is "required")
# and inside COMMAND:
#   cluster.sh crash NODE           cuts the power: kills every process of that node at once. Slurm
#                                   notices within half a minute, or after
#                                   scontrol update NodeName=NODE State=DOWN Reason=power
#   cluster.sh up NODE              starts the node again
#   cluster.sh on NODE COMMAND...   runs COMMAND as root on that node, which has its own mounts
#   cluster.sh hurry                starts requeued jobs now instead of in two minutes
#   cluster.sh settled [SECONDS]    waits until there are no jobs, for 600 seconds at most
#
# The N nodes (4), node1 to nodeN, claim C processors (2) and 16 GB each, whatever this machine has.
# Partitions: main (the default; its jobs are requeued for those of urgent) and urgent. Processes, network
# and mounts are in namespaces of their own: two clusters do not see each other, ports are always free,
# and when this process or its parent ends, even by SIGKILL, everything ends, jobs included.
# The cluster's files are in memory, in /run/carlo_slurm. There is no accounting (no sacct).
set -euo pipefail
here=$(readlink -f "${BASH_SOURCE[0]}")
folder=/run/carlo_slurm

fail() {
  printf 'cluster.sh: %s\n' "$*" >&2
  exit 1
}

skip() {
  printf 'skipped: %s\n' "$*"
  [ "${CARLO_SLURM_TESTS:-}" = required ] || exit 77
  printf 'but CARLO_SLURM_TESTS is "required"\n' >&2
  exit 1
}

run() {
  local nodes=4 cpus=2 program missing=
  while [ $# != 0 ]; do
    case $1 in
      --nodes) nodes=$2 && shift 2 ;;
      --cpus) cpus=$2 && shift 2 ;;
      *) break ;;
    esac
  done
  [ $# != 0 ] || fail 'run what?'
  PATH=$PATH:/usr/sbin:/sbin
  for program in munged slurmctld slurmd sbatch unshare nsenter setsid setpriv ip; do
    command -v "$program" >/dev/null || missing+=" $program"
  done
  [ -z "$missing" ] || skip "these programs are missing:$missing (./carlo setup --developer)"
  [ "$(id -u)" = 0 ] || skip 'a cluster takes root'
  unshare --pid --net --mount --uts --fork true 2>/dev/null || skip 'no namespaces here'
  exec setpriv --pdeathsig KILL unshare --pid --net --mount --uts --fork --kill-child --mount-proc "$here" inside "$nodes" "$cpus" "$@"
}

# Runs as the first process of the namespaces.
inside() {
  local nodes=$1 cpus=$2 number code=0
  shift 2
  # Makes COMMAND's mounts appear on all nodes too.
  mount --make-rshared /
  mount -t tmpfs -o mode=755 none /run
  mkdir -p "$folder/state"
  printf '127.0.0.1 localhost\n10.0.0.1 control\n' >"$folder/hosts"
  mount --bind "$folder/hosts" /etc/hosts
  hostname control
  ip link set lo up
  # Names are looked up only if there is an address other than 127.0.0.1.
  ip address add 10.0.0.1/24 dev lo
  configure "$nodes" "$cpus"
  export SLURM_CONF=$folder/slurm.conf CARLO_CLUSTER=$here
  # Variables of a Slurm around this one.
  unset "${!SLURM_JOB@}" "${!SLURM_ARRAY@}"
  start_control
  for ((number = 1; number <= nodes; ++number)); do start_node "node$number"; done
  wait_for 60 'all nodes' all_idle "$nodes"
  "$@" || code=$?
  [ "$code" = 0 ] || [ "$code" = 77 ] || complaints >&2
  exit "$code"
}

configure() {
  local number
  cat >"$folder/slurm.conf" <<END
ClusterName=carlo
SlurmctldHost=control(10.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmctldPidFile=$folder/control.pid
SlurmctldLogFile=$folder/control.log
SlurmdSpoolDir=$folder/%n.spool
SlurmdPidFile=$folder/%n.pid
SlurmdLogFile=$folder/%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=0
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
ReturnToService=2
SlurmctldTimeout=10
SlurmdTimeout=5
KillWait=5
OverTimeLimit=0
MinJobAge=60
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP PriorityTier=1
PartitionName=urgent Nodes=ALL Default=NO MaxTime=INFINITE State=UP PriorityTier=2 PreemptMode=OFF
END
  for ((number = 1; number <= $1; ++number)); do
    printf 'NodeName=node%d NodeHostname=node%d NodeAddr=10.0.0.1 Port=%d CPUs=%d RealMemory=16000 State=UNKNOWN\n' \
      "$number" "$number" "$((17000 + number))" "$2"
  done >>"$folder/slurm.conf"
}

start_control() {
  dd if=/dev/urandom of="$folder/munge.key" bs=128 count=1 status=none
  chmod 600 "$folder/munge.key"
  setsid munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" \
    >"$folder/munge.out" 2>&1 &
  wait_for 20 munged test -S "$folder/munge.socket"
  setsid slurmctld -D >"$folder/control.out" 2>&1 &
  wait_for 30 slurmctld responds
}

responds() { scontrol ping | grep -q 'is UP'; }

# Puts a node's processes into their own namespace; ending it acts as the power switch.
start_node() {
  local node=$1
  # shellcheck disable=SC2016 # expanded inside
  setsid unshare --pid --mount --propagation slave --uts --fork --kill-child --mount-proc -- \
    bash -c 'hostname "$1" && exec slurmd -D -N "$1"' node "$node" >"$folder/$node.out" 2>&1 &
  printf '%s\n' $! >"$folder/$node.power"
  disown
}

# Prints the first process of a node; nothing if the node is down.
first_process() {
  local children=
  read -r children 2>/dev/null <"/proc/$1/task/$1/children" || true
  printf '%s' "${children%% *}"
}

# The node is gone when the other processes of its namespace are.
crash() {
  local power first
  power=$(cat "$folder/$1.power")
  first=$(first_process "$power")
  [ -n "$first" ] || fail "$1 is down already"
  kill -KILL "$first"
  while [ -n "$(first_process "$power")" ]; do sleep .02; done
}

# The first process of the namespaces adopts it.
up() { start_node "$1"; }

on() {
  local first
  first=$(first_process "$(cat "$folder/$1.power")")
  [ -n "$first" ] || fail "$1 is down"
  shift
  nsenter --target "$first" --mount --uts --pid "$@"
}

all_idle() { [ "$(sinfo --noheader --Node --partition main --states idle --format %N | wc -l)" = "$1" ]; }

# Not at once: a job that starts within the second in which it was requeued is refused by its node
# as "credential revoked", and lost; Slurm's two minutes prevent that.
hurry() {
  local job restarts start
  squeue --noheader --array --states PENDING --Format 'JobID:20,RestartCnt:10,StartTime:30,Reason:30' |
    awk '$4 == "BeginTime" || $4 == "None" {print $1, $2, $3}' | sort -u | while read -r job restarts start; do
    # It may have started meanwhile.
    if [ "$restarts" = 0 ]; then
      scontrol update JobId="$job" StartTime=now || true
    elif [[ $start != N/A && $start > $(date -d '+5 seconds' +%FT%T) ]]; then
      scontrol update JobId="$job" StartTime=now+2 || true
    fi
  done
}

nothing_queued() { [ -z "$(squeue --noheader)" ]; }

# wait_for SECONDS WHAT COMMAND...: waits until it succeeds.
wait_for() {
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < until)) || { complaints >&2 && fail "waited in vain for $what"; }
    sleep .1
  done
}

# Prints the latest messages of the cluster's programs.
complaints() {
  local log
  for log in "$folder"/*.out; do
    printf -- '--- %s\n' "${log##*/}"
    tail -n "${CARLO_CLUSTER_LINES:-8}" "$log"
  done
}

case ${1:-} in
  run | inside | crash | up | on | hurry) "$@" ;;
  settled) wait_for "${2:-600}" 'an empty queue' nothing_queued ;;
  *) sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//p}' "$here" ;;
esac
