#!/usr/bin/env bash
# cost.sh SOURCE BUILD [SUBMISSIONS]: measures the overhead of a class on a cluster, for the figures
# in tests/CLUSTER.md: starting a task, handling a submission (1000 empty ones are taken in and
# written), and checking a finished class. Slurm is faked.
set -euo pipefail
source=$(readlink -f "$1") build=$(readlink -f "$2") count=${3:-1000}
[ -x /usr/bin/time ] || { printf 'cost.sh: it takes /usr/bin/time (apt-get install time)\n' >&2 && exit 1; }
work=$(mktemp -d)
chmod 711 "$work"
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir slurm tmp class
export TMPDIR=$work/tmp
chmod 711 tmp
printf '#!/bin/sh\necho 1\n' >slurm/sbatch
printf '#!/bin/sh\n' >slurm/squeue
chmod +x slurm/*
echo 'a secret' >secret

grade=("$build/bin/carlo_grade" --tree "$source" --build "$build" class --secret-file secret -o out)

# measured WHAT COMMAND...: prints wall seconds, and processor seconds.
measured() {
  local what=$1
  shift
  /usr/bin/time -f '%e %U %S %M' -o time "$@" >log 2>&1 || { cat log >&2 && exit 1; }
  awk -v what="$what" -v n="$count" '{printf "%-44s %7.2f s, %7.2f s of processors, %d MB\n", what, $1, $2 + $3, $4 / 1024}' time
}

eval "mkdir class/student_{1..$count}"
PATH=$work/slurm:$PATH measured "a plan for $count submissions" "${grade[@]}" --slurm --no-wait --tasks "$count"
printf '%-44s %7d bytes a submission\n' 'the plan' "$(($(stat -c %s out/.slurm/plan.json) / count))"

# A task with an empty share: the plan's second task of two, for one submission.
sed -i 's/"tasks": [0-9]*/"tasks": 1000000/' out/.slurm/plan.json
SLURM_ARRAY_TASK_ID=1000000 measured "a task's start" "$build/bin/carlo_grade" --task "$work/out/.slurm/plan.json"
( SLURM_ARRAY_TASK_ID=1000000 "$build/bin/carlo_grade" --task "$work/out/.slurm/plan.json" >/dev/null 2>&1; : ) &
largest=0
while kill -0 $! 2>/dev/null; do
  size=$(du -s --apparent-size "$TMPDIR" 2>/dev/null | cut -f1) || true
  if [ "${size:-0}" -gt "$largest" ]; then largest=$size; fi
done
printf '%-44s %7d kB\n' "a task's temporary files" "$largest"
printf '%-44s %7d kB\n' 'of the build, judges are' "$(du -c --apparent-size "$build"/bin/lab*_judge | tail -n 1 | cut -f1)"

measured "$count that hold nothing, graded" "${grade[@]}" -j 1
PATH=$work/slurm:$PATH measured "a look at $count that are done" "${grade[@]}" --slurm
printf '%-44s %7d files, %d bytes a submission\n' 'output of those' \
  "$(find out -type f | wc -l)" "$(($(du -sb out | cut -f1) / count))"
