#!/usr/bin/env bash
# nightly.sh [--list] [STEP ...]: runs what takes too long for every landing (.ci/run): the named steps, or
# all. Each prints when it began and how long it took; a failure does not stop the others, and the last
# lines say what passed and what failed. Exit code 0: all passed. --list prints the steps.
#
#   thorough     every test of ctest -C thorough: 40 seeds of each lab's solution, the whole corpus of
#                attacks at every level of the sandbox, a class of 100, every broken scene by the program,
#                the whole proving ground, standard errors of all scenes against variances (an hour)
#   sanitizers   every fast test under clang's address and undefined-behaviour sanitizers
#   apart        compiles each file by itself: does it include everything it uses?
#   tidy         clang-tidy of everything, its analyser included
#   build        what the first `./carlo render` and the first `./carlo test 1` compile: at most 15 and 8
#                times tests/profile/yardstick.cpp (60 and 32 processor seconds if that takes 4; nothing else
#                may run)
#   calibration  the grader's errors: 200 seeds of the solutions, starting at another one each day (a false
#                alarm in a thousand gradings shows within the week), and 5 of every mistake
#   fuzz         ten minutes for each reader of foreign bytes
#   paths        1e9 paths through every scene: is one of them not finite, or negative?
#   target_error does --target-error keep its promise, and what does it save? (minutes)
#   shards       renders in 1 to 64 shards, killed and resumed, merged in 20 random orders each: one SHA-256;
#                the cost of eight, and of merging 1000 parts of 512 x 512 (half an hour)
#   classes      a class of 200 on this machine, and ten times on a cluster whose tasks and nodes die: the same
#                class.csv (hours; as root; needs Slurm)
#   slurm        renders on a cluster of virtual nodes: tasks killed at random moments, a time limit (as root)
#   machines     the README's commands in a bare Debian 12 and 13; fast tests for ARM under QEMU and with
#                LLVM's standard library (as root; needs debootstrap and qemu-user-static; hours the first
#                time, and 20 GB)
set -uo pipefail
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/..")
cd "$root" || exit 1

all=(thorough sanitizers apart tidy build calibration fuzz paths target_error shards slurm classes machines)

thorough() {
  ./carlo test --solutions --all -C thorough
}

sanitizers() {
  cmake --preset ci >/dev/null && ninja -C build/ci --quiet all && ctest --test-dir build/ci -L fast -j 2 --output-on-failure
}

apart() {
  cmake --preset release -B build/apart -DCARLO_UNITY=OFF -DCARLO_MISTAKES=OFF >/dev/null && ninja -C build/apart --quiet all
}

tidy() {
  tests/tidy.sh --all
}

build() {
  local code=0
  tests/profile/build.sh --at-most 15 carlo_render || code=1
  tests/profile/build.sh --at-most 8 carlo_verbs lab01_judge lab01_worker || code=1
  return "$code"
}

calibration() {
  ./carlo grade --calibrate --seeds 200 --first-seed "$((1001 + 1000 * ($(date +%s) / 86400 % 1000)))"
}

fuzz() {
  ./carlo fuzz --seconds 600 --jobs 2
}

paths() {
  ninja -C build/release --quiet carlo_many_paths && build/release/bin/carlo_many_paths --paths 1e9
}

target_error() {
  ninja -C build/release --quiet carlo_target_error && build/release/bin/carlo_target_error
}

shards() {
  ./carlo merge --help >/dev/null && ./carlo render --help >/dev/null &&
    tests/renderer/shards_in_full.sh build/release/bin "$root"
}

classes() {
  ninja -C build/release --quiet all && rm -rf build/class_in_full &&
    tests/slurm/class_in_full.sh . build/release build/class_in_full
}

slurm() {
  ./carlo render --help >/dev/null &&
    CARLO_SLURM_TESTS=required tests/slurm/render_test.sh "$root/build/release/bin/carlo_render" "$root" \
      third_killed rounds_killed time_limit
}

machines() {
  "$root/tests/machines/chroot.sh" bookworm trixie aarch64 libcxx
}

case ${1:-} in
  --help | -h | --list)
    sed -n '2,/^set/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    exit ;;
esac
steps=("$@")
[ ${#steps[@]} != 0 ] || steps=("${all[@]}")
for step in "${steps[@]}"; do
  [[ " ${all[*]} " = *" $step "* ]] || { printf 'nightly: there is no step %s; there are: %s\n' "$step" "${all[*]}" >&2 && exit 1; }
done

summary='' failed=0
for step in "${steps[@]}"; do
  printf '\n=== %s, %s\n' "$step" "$(date +%H:%M:%S)"
  begun=$SECONDS
  if "$step"; then word=passed; else word=FAILED && failed=1; fi
  summary+=$(printf '%-12s %s in %d s' "$step" "$word" "$((SECONDS - begun))")$'\n'
done
printf '\n%s' "$summary"
exit "$failed"
