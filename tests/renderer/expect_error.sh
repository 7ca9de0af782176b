# shellcheck shell=bash
# Shared by tests of a program's messages. To be sourced; call `finish` last.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

complain() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

# [lines=N] expect_error PATTERN PROGRAM ARGUMENTS...: expects N lines on stderr (1), each matching
# PATTERN, exit code 1, and no file.
expect_error() {
  local pattern=$1 program=$2 code=0 out=$scratch/out
  shift 2
  rm -rf "$out" && mkdir "$out"
  (cd "$out" && "$program" "$@") >"$scratch/stdout" 2>"$scratch/stderr" || code=$?
  [ "$code" = 1 ] || complain "exit code $code for: $*"
  [ "$(grep -Ec "$pattern" "$scratch/stderr")" = "${lines:-1}" ] || complain "'$(cat "$scratch/stderr")' is not '$pattern'"
  [ "$(wc -l <"$scratch/stderr")" = "${lines:-1}" ] || complain "not ${lines:-1} lines for: $*: $(cat "$scratch/stderr")"
  [ ! -s "$scratch/stdout" ] || complain "output on stdout for: $*"
  [ -z "$(find "$out" -type f)" ] || complain "files were left by: $*"
}

# Fails if there was any complaint.
finish() {
  printf '%d failures\n' "$failures"
  [ "$failures" = 0 ]
}
