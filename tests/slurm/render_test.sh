#!/usr/bin/env bash
# render_test.sh RENDERER SOURCE [STEP ...]: `./carlo render --slurm` on a real Slurm: whatever
# happens to tasks, nodes and the submitting process, the image has the bits of a single process.
# Without steps, runs the short ones; nightly: third_killed time_limit rounds_killed.
set -euo pipefail
if [ "${1:-}" != --inside ]; then
  exec "$(dirname "${BASH_SOURCE[0]}")/cluster.sh" run --nodes 3 "${BASH_SOURCE[0]}" --inside "$@"
fi
renderer=$2 source=$3
shift 3
. "$source/tests/renderer/expect_error.sh"
cd "$scratch"
short=(plain twice_at_once killed requeued node_down rounds full_disk read_only refused)
[ $# != 0 ] || set -- "${short[@]}"
scene=$source/common/scenes/cornell_phong.xml

# of SPP [ARGUMENTS...]: sets a render's own arguments.
of() { render=("$renderer" "$scene" --quiet --size 48x48 --spp "$@"); }

# whole NAME: renders in one process, once for all with these arguments.
whole() { [ -s "$1.exr" ] || "${render[@]}" -o "$1"; }

same() { cmp "$1.exr" "$2.exr" || complain "$2: other bits"; }

# Prints how many arrays and merges were submitted for an image, as long as Slurm remembers them.
submitted() {
  local name
  name=$(sed -n 's/.*"jobs": "\(.*\)".*/\1/p' "$1.slurm/plan.json")
  scontrol --oneliner show jobs | grep " JobName=$name$2 " | sed -n 's/.*ArrayJobId=\([0-9]*\).*/\1/p' | sort -u | wc -l
}

# tasks NAME: prints the processes of an image's tasks.
tasks() { pgrep -f -- "^$scratch/$1.slurm/carlo_render --slurm-task" || true; }

# until_there COMMAND...: waits until it prints something.
until_there() {
  local tries
  for ((tries = 0; tries < 1200; ++tries)); do
    [ -z "$("$@" 2>/dev/null)" ] || return 0
    sleep .05
  done
  complain "waited in vain: $*"
}
checkpoints() { ls "$1".slurm/*.part; }

# awaited PID NAME: it must succeed, and the image must be right.
awaited() {
  local code=0
  wait "$1" || code=$?
  [ "$code" = 0 ] || complain "$2: exit code $code: $(cat "$2.stderr")"
}

# Requeued jobs need not wait two minutes here.
while sleep .5; do "$CARLO_CLUSTER" hurry; done >/dev/null 2>&1 &
hurrying=$!

plain() {
  of 64
  whole whole64
  "${render[@]}" -o plain --slurm --tasks 5 --threads 2 --partition urgent --time 10
  same whole64 plain
  [ -z "$(checkpoints plain 2>/dev/null)" ] || complain 'parts are left'
  # A finished image is not rendered again.
  stat -c %Y.%i plain.{exr,png,json} >before
  "${render[@]}" -o plain --slurm
  stat -c %Y.%i plain.{exr,png,json} | cmp - before || complain 'what was there was written again'
  [ "$(submitted plain '') $(submitted plain _merge)" = '1 1' ] || complain 'jobs for what is done'
  # More shards than blocks of samples; without waiting.
  (cd / && "${render[@]/48x48/16x16}" -o "$scratch/tiny" --slurm --no-wait --tasks 20)
  "$CARLO_CLUSTER" settled
  "${render[@]/48x48/16x16}" -o tiny_whole
  same tiny_whole tiny
  expect_error 'was rendered, and is gone since; to render it again, remove' \
    bash -c 'cd "$1" && rm tiny.exr && shift && "$@"' - "$scratch" "${render[@]/48x48/16x16}" -o tiny --slurm
}

twice_at_once() {
  local pids=() pid
  of 256
  whole whole256
  for _ in 1 2 3; do
    "${render[@]}" -o twice --slurm --tasks 4 2>>twice.stderr &
    pids+=($!)
  done
  for pid in "${pids[@]}"; do awaited "$pid" twice; done
  same whole256 twice
  [ "$(submitted twice '') $(submitted twice _merge)" = '1 1' ] ||
    complain "three submissions at once: $(submitted twice '') arrays, $(submitted twice _merge) merges"
}

# held NAME COUNT: waits until the image's tasks, COUNT of them, are stopped (SIGSTOP), each with a
# checkpoint: so later steps cannot come after their end, however fast or busy the processor is.
held() {
  local tries task index
  local -A stopped=()
  for ((tries = 0; tries < 6000 && ${#stopped[@]} < $2; ++tries)); do
    for task in $(tasks "$1"); do
      # It may have ended meanwhile.
      index=$(tr '\0' '\n' <"/proc/$task/environ" 2>/dev/null | sed -n 's/^SLURM_ARRAY_TASK_ID=//p') || true
      [ -n "$index" ] && [ -e "$1.slurm/$index.part" ] && kill -STOP "$task" && stopped[$task]=1
    done
    sleep .01
  done 2>/dev/null
  ((${#stopped[@]} == $2)) || complain "$1: ${#stopped[@]} of $2 tasks could be held"
}
go_on() { tasks "$1" | xargs --no-run-if-empty kill -CONT 2>/dev/null || true; }

# Kills a third of the tasks, and the submitting process, with SIGKILL.
killed() {
  local pid
  of 32768 --checkpoint .1
  whole whole32768
  "${render[@]}" -o killed --slurm --tasks 6 2>killed.stderr &
  pid=$!
  held killed 6
  kill -KILL $pid
  tasks killed | shuf -n 2 | xargs kill -KILL
  wait $pid 2>/dev/null || true
  go_on killed
  "${render[@]}" -o killed --slurm 2>killed.stderr &
  awaited $! killed
  same whole32768 killed
}

# Requeues tasks by Slurm, and by themselves when their time is up.
requeued() {
  local pid id
  of 32768 --checkpoint .1
  whole whole32768
  "${render[@]}" -o again --slurm --tasks 4 2>again.stderr &
  pid=$!
  held again 4
  id=$(squeue --noheader --states RUNNING --format %F | head -1)
  scontrol requeue "${id}_1"
  scancel --batch --signal USR1 "${id}_2" "${id}_3"
  sleep .5
  go_on again
  awaited $pid again
  same whole32768 again
  grep -q 'time is up; queued again' again.slurm/tasks/*.txt || complain 'no task was queued again'
  [ "$(submitted again '')" = 1 ] || complain "requeued tasks were submitted again: $(tail -n 3 again.slurm/*/*.txt)"
}

node_down() {
  local pid
  of 32768 --checkpoint .1
  whole whole32768
  "${render[@]}" -o down --slurm --tasks 6 2>down.stderr &
  pid=$!
  held down 6
  "$CARLO_CLUSTER" crash node2
  scontrol update NodeName=node2 State=DOWN Reason=power
  sleep .5
  "$CARLO_CLUSTER" up node2
  go_on down
  awaited $pid down
  same whole32768 down
}

# With a target error, in rounds.
rounds() {
  of 192 --target-error .2 --technique path
  whole adaptive
  "${render[@]}" -o rounds --slurm --tasks 3
  same adaptive rounds
  cmp adaptive.samples.png rounds.samples.png || complain 'other numbers of samples'
  [ -z "$(find rounds.slurm -maxdepth 1 -name '*.exr')" ] || complain 'files of rounds are left'
}

full_disk() {
  mkdir -p small
  mount -t tmpfs -o size=4m none small
  of 8
  render=("${render[@]/48x48/256x256}")
  expect_error 'shards, the first of them .* came to nothing.*disk full' "${render[@]}" -o "$scratch/small/image" --slurm --tasks 2
  [ ! -e small/image.exr ] || complain 'an image on a full disk'
  mount -o remount,size=64m small
  "${render[@]}" -o small/image --slurm
  "${render[@]}" -o whole256x256
  same whole256x256 small/image
  umount small
}

# Read-only for all at first, then only for the nodes.
read_only() {
  local node
  mkdir -p closed
  of 64
  mount -t tmpfs none closed
  mount -o remount,ro closed
  expect_error 'cannot make .*: Read-only file system' "${render[@]}" -o "$scratch/closed/image" --slurm --tasks 2
  mount -o remount,rw closed
  for node in node1 node2 node3; do "$CARLO_CLUSTER" on $node mount -o remount,bind,ro "$scratch/closed"; done
  expect_error 'came to nothing' "${render[@]}" -o "$scratch/closed/image" --slurm --tasks 2
  for node in node1 node2 node3; do "$CARLO_CLUSTER" on $node mount -o remount,bind,rw "$scratch/closed"; done
  "${render[@]}" -o closed/image --slurm
  whole whole64
  same whole64 closed/image
  umount closed
}

refused() {
  of 64
  "${render[@]}" -o taken --slurm --tasks 2 --no-wait
  local image=$scratch/taken
  expect_error 'cannot continue .*: its seed is 1, this render.s 2; remove it' "${render[@]}" -o "$image" --slurm --seed 2
  expect_error 'its number of tasks is 2, this render.s 3' "${render[@]}" -o "$image" --slurm --tasks 3
  expect_error 'its sampler is sobol' "${render[@]}" -o "$image" --slurm --sampler independent
  expect_error 'slurm does not go with --seconds' "$renderer" "$scene" --seconds 3 -o "$image" --slurm
  expect_error 'slurm does not go with --resume' "${render[@]}" -o "$image" --slurm --resume "$image.exr"
  expect_error 'slurm does not go with --shard' "${render[@]}" -o "$image" --slurm --shard 1/2
  expect_error 'slurm does not go with --page' "${render[@]}" -o "$image" --slurm --page
  expect_error '^error: --tasks is for --slurm' "${render[@]}" -o "$image" --tasks 2
  expect_error '^error: --time is for --slurm' "${render[@]}" -o "$image" --time 2
  expect_error '^error: --partition is for --slurm' "${render[@]}" -o "$image" --partition main
  expect_error '^error: --no-wait is for --slurm' "${render[@]}" -o "$image" --no-wait
  expect_error 'tasks' "${render[@]}" -o "$image" --slurm --tasks 0
  ! "${render[@]}" -o nowhere --slurm --partition nowhere 2>stderr || complain 'a partition that is not there'
  grep -q 'invalid partition' stderr || complain "a partition that is not there: $(cat stderr)"
  expect_error 'there is no sbatch here' env PATH=/nowhere "${render[@]}" -o "$scratch/nowhere" --slurm
  "$CARLO_CLUSTER" settled
}

# --- nightly -------------------------------------------------------------------------------------

# killing NAME PID: until PID ends, kills one in three of the image's tasks, at a random moment in
# its first second.
killing() {
  local task
  local -A seen=()
  while kill -0 "$2" 2>/dev/null; do
    for task in $(tasks "$1"); do
      [ -z "${seen[$task]:-}" ] || continue
      seen[$task]=1
      [ $((RANDOM % 3)) != 0 ] ||
        (sleep ".$((RANDOM % 10))" && kill -KILL "$task" 2>/dev/null && printf '%s\n' "$task" >>"$1.killed") &
    done
    sleep .05
  done
}

# A third of the tasks killed at random moments, and one SHA-256 of the sums (the EXR holds nothing
# else).
third_killed() {
  local name file pid
  for name in cornell_phong caustics mesh; do
    file=$source/common/scenes/$name.xml
    [ $name != mesh ] || file=$source/tests/common/scenes/meshes.xml
    render=("$renderer" "$file" --quiet --size 64x64 --spp 16384 --checkpoint .2)
    : >"$name.killed"
    "${render[@]}" -o "whole_$name"
    "${render[@]}" -o "$name" --slurm --tasks 12 2>"$name.stderr" &
    pid=$!
    killing "$name" $pid &
    # The waiting process gives up if all tasks failed: the same command resumes.
    until wait $pid; do
      printf '%s: again, after: %s\n' "$name" "$(cat "$name.stderr")"
      "${render[@]}" -o "$name" --slurm 2>"$name.stderr" &
      pid=$!
    done
    same "whole_$name" "$name"
    sha256sum "whole_$name.exr" "$name.exr"
    printf '%s: killed %d times, 12 tasks\n' "$name" "$(wc -l <"$name.killed")"
  done
}

rounds_killed() {
  local pid
  of 2048 --target-error .05 --checkpoint .2
  "${render[@]}" -o adaptive_long
  "${render[@]}" -o rounds_long --slurm --tasks 4 2>rounds_long.stderr &
  pid=$!
  killing rounds_long $pid &
  until wait $pid; do
    "${render[@]}" -o rounds_long --slurm 2>rounds_long.stderr &
    pid=$!
  done
  cmp adaptive_long.png rounds_long.png || complain 'another image in rounds'
}

# Longer than a task may take: Slurm's shortest limit is a minute, and its warning may come that
# early.
time_limit() {
  of 400000 --checkpoint 1000
  "${render[@]}" -o limited --slurm --tasks 2 --time 2
  grep -q 'time is up; queued again' limited.slurm/tasks/*.txt || complain 'no task met its limit'
  "${render[@]}" -o unlimited
  same unlimited limited
}

for step in "$@"; do
  begun=$SECONDS
  "$step"
  printf '%-14s %d s\n' "$step" $((SECONDS - begun))
done
kill $hurrying
finish
