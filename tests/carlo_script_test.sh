#!/usr/bin/env bash
# carlo_script_test.sh SOURCE VERBS: tests, with stand-ins for the programs that it starts, what
# ./carlo does before and around them. A bad call gives one line on stderr and exit code 1.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/stand_in_tree.sh"

# --- bad calls -----------------------------------------------------------------------------------

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
expect_error 'takes no other argument' test --hard 4
expect_error 'no exercise 1.9' test 1.1 1.9
expect_error 'give whole labs' test 1 2 1.1
expect_error 'exercise 2.1 is not in lab 1' test 1 2.1
expect_error 'is for one exercise, got 2' test 1.1 1.2 --json x.json
expect_error 'is for one exercise, got 2' test 1.1 1.2 --page x.html
expect_error 'no lab 99' lab 99
expect_error 'no lab 99' watch 99
expect_error 'takes one lab' watch 1 2
expect_error 'hint takes one exercise.* got 1.1 and 1.2' hint 1.1 1.2
expect_error 'replay takes one exercise, got 1.1 and 1.2' replay 1.1 1.2
expect_error "does not know '--frob'" watch --frob
expect_error 'no lab labs/99_frob' test labs/99_frob/frob.cpp
expect_error 'render, peers, build, tests' bench frob
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

# --- calls ---------------------------------------------------------------------------------------

expect 0 'usage: ./carlo VERB' --help
expect 0 'setup .* install missing packages' help
expect 0 '^carlo_course status --root .*tree --json$' status --json
expect 0 '^carlo_course hint --root .*tree 1.2$' hint 1.2
expect 0 '^carlo_course hint --root .*tree 1.2 --all$' hint --all 1.2
expect 1 '^usage: ./carlo hint' hint
expect 0 '^usage: ./carlo test' test 1 --help
expect 0 '^lab01$' lab 1
expect 0 '^lab01 --quick$' lab labs/01_integration/integration.cpp --quick
expect 0 '^lab01_judge --lab .*lab.json --worker .* --book .*verdicts.json --failure-page out/test01.html$' test 1
expect 0 '^lab01_judge .* --failure-page out/test1.3.html --exercise 1.3$' test 1.2 1.3
expect 0 '^lab01_judge .* --seed 7 .*--exercise 1.2$' test 1.2 --seed 7
expect 0 '^lab01_judge .* --page x.html$' test 1 --page x.html
expect 0 '^carlo_watch --root .* --poll 1$' watch 1 --poll
expect 0 '^lab08_render --default-scene .*cornell_phong.xml --spp 4$' render --mine --spp 4
stand_in "$tools/ctest"
expect 0 '^ctest --output-on-failure -j [0-9]+ -L .first.$' test --solutions
expect 0 '^ctest --output-on-failure -j [0-9]+ -L .first. -j 4$' test --solutions -j 4
expect 0 '^ctest --output-on-failure -j [0-9]+$' test --solutions --all
expect 0 '^ctest --output-on-failure -j [0-9]+ -LE slow$' test --solutions --all -LE slow
for choice in '-R renderer' --rerun-failed '-C thorough'; do
  # shellcheck disable=SC2086
  expect 0 "^ctest --output-on-failure -j [0-9]+ $choice\$" test --solutions $choice
done
expect 0 '^ctest --output-on-failure -j [0-9]+ -R .lab01[[]..$' test 1 --solutions
program "$tree/build/release/bin/lab01_judge" 'while [ $# != 0 ]; do [ "$1" != --probes ] || : >"$2"; shift; done'
expect 0 '^carlo_replay 1.2 --lab .*lab01_worker$' replay 1.2
program "$tree/build/release/bin/lab01_judge" 'exit 1'
expect 1 '' test 1

# A stub is answered before there is a judge; what somebody has begun is not.
labs=0
rm "$tree/build/release/bin/lab01_judge"
for folder in "$tree"/labs/0*; do
  labs=$((labs + 1))
  cp -R "$source/labs/${folder##*/}"/* "$folder/"
  expect 1 "^Lab $labs compiles, and all its [1-9][0-9]* exercises are not implemented yet: 0 points\$" test "$labs"
done
[ "$labs" = 9 ] || failed "$labs labs"
# Without a judge to copy, the stand-in's build is a failure.
expect_no_answer() { expect 1 'the code does not compile' test "$@"; }
own=$tree/labs/01_integration/integration.cpp
cp "$own" "$scratch/stub.cpp"
expect_no_answer 1.1
expect_no_answer 1 --verbose
expect_no_answer 1 2
sed 's|^  // 2. Add up the values of f.$|  return 1;|' "$scratch/stub.cpp" >"$own"
expect_no_answer 1
sed '0,/^  carlo::not_implemented.*/s|||' "$scratch/stub.cpp" >"$own"
expect_no_answer 1
mv "$scratch/stub.cpp" "$own"
stand_in "$tree/build/release/bin/lab01_judge"

# Exit codes and signals of programs.
program "$tree/build/release/bin/lab01" 'kill -SEGV $$'
expect 1 'crashed: invalid memory access' lab 1
expect 1 'To find the line .*CARLO_PRESET=debug ./carlo lab 1' lab 1
program "$tree/build/release/bin/lab01" 'exit 141'
expect 141 '' lab 1
program "$tree/build/release/bin/lab01" 'exit 3'
expect 3 '' lab 1
stand_in "$tree/build/release/bin/lab01"

# --- builds --------------------------------------------------------------------------------------

# Removes the folders of killed runs, and no others.
run=$tree/build/release/run
mkdir -p "$run/999999999" "$run/$$"
touch -t 202001010000 "$run/999999999" "$run/$$"
expect 0 '^lab01$' lab 1
[ ! -e "$run/999999999" ] || failed "a killed run's folder stays"
[ -e "$run/$$" ] || failed "the folder of a run that lives was removed"
rm -r "${run:?}/$$"
[ -z "$(ls "$run")" ] || failed "these stay: $(ls "$run")"

# Announces a long wait at once, then says every ten seconds how far it is, even while one file takes longer.
program "$tools/ninja" 'case " $* " in
  *" -n "*) for step in {1..21}; do printf "[%d] c++\n" "$step"; done ;;
  *) printf "@1/21 c++\n@10/21 c++\n" && sleep 11.5 && printf "@11/21 c++\n" ;;
esac'
carlo lab 1 >"$scratch/said" 2>&1
grep -q 'building .a minute or more' "$scratch/said" || failed "no announcement: $(cat "$scratch/said")"
[ "$(grep '^carlo: building [0-9]' "$scratch/said")" = 'carlo: building 10/21, about 20 s left' ] ||
  failed "progress on a pipe: $(cat "$scratch/said")"
# So do the suite's own tests, whose output and exit code stay ctest's.
cp "$tools/ctest" "$scratch/ctest"
program "$tools/ctest" 'printf " 9/20 Test  #3: one .. Passed 1 sec\n" && sleep 11.5 && printf "10/20 Test #4: two ... Failed\n" && exit 8'
code=0
carlo test --solutions >"$scratch/said" 2>"$scratch/progress" || code=$?
[ "$code:$(wc -l <"$scratch/said"):$(grep -c '^carlo: testing 9/20, about 20 s left$' "$scratch/progress")" = 8:2:1 ] ||
  failed "progress of tests: exit code $code, $(cat "$scratch/said" "$scratch/progress")"
mv "$scratch/ctest" "$tools/ctest"
program "$tools/ninja" 'echo "a.cpp:1:1: error: x"; exit 1'
expect_error_in_build() { expect 1 'the code does not compile .the compiler.s full output: .*build.log' lab 1; }
expect_error_in_build
expect 1 '^carlo_course explain --root' lab 1
grep -q 'a.cpp:1:1: error: x' "$tree/build/release/build.log" || failed "the compiler's words are lost"
program "$tools/ninja" 'echo "ninja: build stopped: interrupted by user."; exit 2'
expect 130 '^carlo: stopped while building$' lab 1
# A hint builds nothing if its program exists.
program "$tools/ninja" 'case " $* " in *" -n "*) ;; *) exit 1 ;; esac'
expect 0 '^carlo_course hint' hint 1.2
program "$tools/ninja" ''

# A signal while it judges ends the judge and ./carlo.
program "$tree/build/release/bin/lab01_judge" 'echo begun; sleep 60 & wait'
(cd "$scratch" && PATH=$tools:$PATH exec setsid "$tree/carlo" test 1 >"$scratch/said" 2>&1) &
carlo=$!
for _ in {1..600}; do ! grep -q begun "$scratch/said" || break; sleep .1; done
kill -TERM "$carlo"
code=0
wait "$carlo" || code=$?
[ "$code" = 143 ] || failed "exit code $code after SIGTERM: $(cat "$scratch/said")"
[ -z "$(ls "$run")" ] || failed "after SIGTERM these stay: $(ls "$run")"

# --- where it stands -----------------------------------------------------------------------------

# Works through links, from any folder; a relative link is resolved from its own folder.
mkdir "$scratch/links"
ln -s ../tree/carlo "$scratch/links/first"
ln -s "$scratch/links/first" "$scratch/second"
(cd / && PATH=$tools:$PATH "$scratch/second" status) | grep -q "^carlo_course status --root $(cd "$tree" && pwd -P)\$" ||
  failed "through links"

finish
