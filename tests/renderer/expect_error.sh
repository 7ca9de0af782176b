# shellcheck shell=bash
# What tests of a program's messages share. To be sourced; `finish` comes last.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

complain() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

# expect_error PATTERN PROGRAM ARGUMENTS...: one line on stderr, exit code 1, and no file.
expect_error() {
  local pattern=$1 program=$2 code=0 out=$scratch/out
  shift 2
  rm -rf "$out" && mkdir "$out"
  (cd "$out" && "$program" "$@") >"$scratch/stdout" 2>"$scratch/stderr" || code=$?
  [ "$code" = 1 ] || complain "exit code $code for: $*"
  [ "$(wc -l <"$scratch/stderr")" = 1 ] || complain "not one line for: $*: $(cat "$scratch/stderr")"
  grep -Eq "$pattern" "$scratch/stderr" || complain "'$(cat "$scratch/stderr")' is not '$pattern'"
  [ ! -s "$scratch/stdout" ] || complain "output on stdout for: $*"
  [ -z "$(find "$out" -type f)" ] || complain "files were left by: $*"
}

# Fails when anything was complained of.
finish() {
  printf '%d failures\n' "$failures"
  [ "$failures" = 0 ]
}
