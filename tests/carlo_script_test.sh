#!/usr/bin/env bash
# carlo_script_test.sh SOURCE: what the script ./carlo does on invalid calls, before anything is
# built: one line on stderr, exit code 1, and no hang.
set -euo pipefail
carlo=$1/carlo
failures=0

expect_error() {
  local pattern=$1 code=0 text
  shift
  text=$(timeout 20 "$carlo" "$@" 2>&1 >/dev/null) || code=$?
  if [ "$code" != 1 ] || [ "$(wc -l <<<"$text")" != 1 ] || ! grep -Eq "$pattern" <<<"$text"; then
    printf 'FAILED: ./carlo %s: exit code %s, "%s"\n' "$*" "$code" "$text"
    failures=$((failures + 1))
  fi
}

expect_error "no verb 'frobnicate'; ./carlo alone" frobnicate
expect_error 'did you mean ./carlo test\?' tset
expect_error 'did you mean ./carlo status\?' Statsu 1
expect_error 'did you mean ./carlo lab\?' labs 1
expect_error 'no lab 99; there are: 1, 2' hint 99.1
expect_error 'no exercise 1.99; lab 1 has 1.1 to 1[.][0-9]+' hint 1.99
expect_error 'which exercise of lab 1\? There are 1.1 to 1[.][0-9]+' hint 1
expect_error 'an exercise is a number such as' hint one
expect_error 'no exercise 1.99; lab 1 has 1.1 to 1[.][0-9]+' replay 1.99
expect_error 'no exercise 1.99' test 1.99
expect_error 'no exercise 1.0' test 1 --exercise 1.0
expect_error 'no lab 99' test 99
expect_error 'a lab is a number' test x
expect_error 'no lab 99' test 1 99
expect_error 'needs a value' test --seed
expect_error 'for one lab' test 1 2 --page x.html
expect_error 'takes nothing else' test --hard 4
expect_error 'no exercise 1.9' test 1.1 1.9
expect_error 'exercises of one lab, or labs' test 1 2 1.1
expect_error 'exercise 2.1 is none of lab 1' test 1 2.1
expect_error 'is for one exercise, got 2' test 1.1 1.2 --json x.json
expect_error 'is for one exercise, got 2' test 1.1 1.2 --page x.html
expect_error 'no lab 99' lab 99
expect_error 'no lab 99' watch 99
expect_error 'takes one lab' watch 1 2
expect_error 'hint takes one exercise.* got 1.1 and 1.2' hint 1.1 1.2
expect_error 'replay takes one exercise, got 1.1 and 1.2' replay 1.1 1.2
expect_error "does not know '--frob'" watch --frob
expect_error 'no lab labs/99_frob' test labs/99_frob/frob.cpp
expect_error 'render, paths, target-error, integrators' bench frob
expect_error 'no lab 99' grade --calibrate --labs 1,99
expect_error 'developer' setup --frob
expect_error 'developer' setup --developer frob
expect_error 'no lab 99' replay 99.1
expect_error 'a deck is a number' slides x
expect_error 'one thing at a time' slides --html --check
expect_error 'does not know' slides --frob
expect_error 'which exercise of lab 1' replay 1
expect_error 'an exercise is a number' replay
expect_error 'needs a value' replay 1.2 --probe
expect_error 'does not know' replay 1.2 --frob
expect_error 'which question' replay 1.2 --gdb
expect_error 'no lab 99' starter --through 99
expect_error 'a lab is a number' starter --through x
expect_error 'needs the last lab' starter
expect_error '.tar.gz or a .zip' starter --through 1 -o frob
expect_error 'needs a lab' gradescope
expect_error 'no lab 99' gradescope 99
expect_error 'takes a .zip' gradescope 1 -o frob.tar.gz
expect_error 'no such file' gradescope 1 --secret-file /no/such/file

# Through a link, from another folder.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
ln -s "$carlo" "$scratch/carlo"
(cd "$scratch" && ./carlo --help) | grep -q 'usage: ./carlo VERB' || failures=$((failures + 1))
carlo=$scratch/carlo
expect_error 'no lab 99' lab 99
[ "$(ls "$scratch")" = carlo ] || failures=$((failures + 1))

printf '%d failures\n' "$failures"
[ "$failures" = 0 ]
