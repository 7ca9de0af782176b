#!/bin/sh
# handed_in.sh ATTACK DRAFT TARGET TREE: attacks, and accidents, that hand in something else than a
# folder with the exercise file. ATTACK is a function here, called with the other three: DRAFT is a
# folder with the file and room to work in, TARGET the submission's path without a suffix, TREE the
# repository. README.md describes the lines above each function.
set -eu

#= line_ends
# line ends and byte order mark as Windows writes them, no newline at the end
#: points {"1.1": 2}
line_ends() {
  mkdir -p "$2"
  { printf '\357\273\277'; sed 's/$/\r/' "$1/integration.cpp"; printf '// the end'; } > "$2/integration.cpp"
}

#= lacks_files
# a submission of other files
#: state "not_submitted"
lacks_files() {
  mkdir -p "$2/labs/01_integration"
  cp "$1/integration.cpp" "$2/labs/01_integration/integration.cpp.txt"
  echo 'I did it' > "$2/labs/01_integration/README.md"
}

#= two_candidates
# two files of the same name and different content
#: state "refused"
two_candidates() {
  mkdir -p "$2/labs/01_integration/old"
  cp "$1/integration.cpp" "$2/labs/01_integration/"
  { cat "$1/integration.cpp"; echo '// older'; } > "$2/labs/01_integration/old/integration.cpp"
}

#= odd_names
# files whose names hold line ends, commands, tags, quotes, escape sequences and bytes that are no
# text
#: points {"1.1": 2}
#: absent ["\u001b[2J"]
odd_names() {
  mkdir -p "$2"
  cp "$1/integration.cpp" "$2/"
  touch "$2/; touch evil.txt" "$2/\$(touch evil.txt)" "$2/<script>alert(1)" \
    "$2/a\"b,c" "$2/$(printf 'two\nlines: 20 of 20 points')" "$2/$(printf '\033[2J')" \
    "$2/$(printf '\377\376')" "$2/-rf" "$2/integration.cpp "
}

#= links
# links in the place of files and folders: to the solution, to a device, to folders of others, to
# itself
#: state "not_submitted"
#: absent ["from_old_mean"]
links() {
  mkdir -p "$2/a" "$2/b" "$2/c"
  ln -s "$3/solutions/01_integration/integration.cpp" "$2/a/integration.cpp"
  ln -s /dev/zero "$2/b/integration.cpp"
  mkfifo "$2/c/integration.cpp"
  ln -s "$3/solutions" "$2/labs"
  ln -s . "$2/self"
}

#= huge_file
# an exercise file of 300 GB that takes no room
#: state "not_submitted"
huge_file() {
  mkdir -p "$2"
  truncate -s 300G "$2/integration.cpp"
}

#= long_line
# an exercise file of a megabyte in one line that opens a million brackets
#: state "does_not_compile"
#: seconds 300
long_line() {
  mkdir -p "$2"
  { cat "$1/integration.cpp"; printf 'int x = '; head -c 1000000 /dev/zero | tr '\0' '('; } \
    > "$2/integration.cpp"
}

#= spoilt_archive
# an archive that is cut short within the file
#: state "not_submitted"
spoilt_archive() {
  tar -C "$1" -czf "$1/whole.tar.gz" integration.cpp
  head -c 500 "$1/whole.tar.gz" > "$2.tar.gz"
}

#= archive_bomb
# an archive that unpacks to more than is ever read
#: state "not_submitted"
archive_bomb() {
  mkdir -p "$1/x"
  truncate -s 700M "$1/x/integration.cpp"
  tar -C "$1/x" -cf - . | gzip -1 > "$2.tar.gz"
  rm -r "$1/x"
}

#= archives_in_archives
# archives within archives, each of them a bomb: more to unpack and to keep than any machine has
#: state "refused"
#: seconds 60
archives_in_archives() {
  mkdir -p "$1/x"
  truncate -s 60M "$1/zeros"
  cp "$1/zeros" "$1/x/integration.cpp"
  tar -C "$1/x" -czf "$1/inner.tar.gz" integration.cpp
  mkdir "$1/y"
  for i in $(seq 400); do ln "$1/inner.tar.gz" "$1/y/$i.tar.gz"; done
  tar --hard-dereference -C "$1/y" -cf "$2.tar" .
}

#= links_in_tar
# an archive with links, devices and pipes in the place of the file
#: state "not_submitted"
#: absent ["from_old_mean"]
links_in_tar() {
  mkdir -p "$1/x/a" "$1/x/b" "$1/x/c"
  ln -s "$3/solutions/01_integration/integration.cpp" "$1/x/a/integration.cpp"
  mkfifo "$1/x/b/integration.cpp"
  ln -s /etc/passwd "$1/x/other"
  ln "$1/x/other" "$1/x/c/integration.cpp"
  tar -C "$1/x" -czf "$2.tar.gz" .
}

#= paths_out
# a tar archive whose entries lead out of it and to the root; beside them an honest file
#: points {"1.1": 2}
paths_out() {
  cd "$1"
  echo stolen > evil.txt
  mkdir -p labs/01_integration && cp integration.cpp labs/01_integration/
  tar -P -cf "$2.tar" --transform 's,^evil.txt,../../evil.txt,' evil.txt
  tar -P -rf "$2.tar" --transform "s,^evil.txt,$(dirname "$2")/evil.txt," evil.txt
  tar -P -rf "$2.tar" --transform 's,^evil.txt,labs/../../canary/canary.txt,' evil.txt
  tar -P -rf "$2.tar" labs
}

#= zip_paths_out
# a zip archive whose entries lead out of it; beside them an honest file
#: points {"1.1": 2}
zip_paths_out() {
  mkdir -p "$1/a/b"
  cp "$1/integration.cpp" "$1/a/b/"
  echo stolen > "$1/evil.txt"
  cd "$1/a/b"
  cmake -E tar cf "$2.zip" --format=zip ../../evil.txt integration.cpp
}

#= replaces_files
# a whole tree, changed where it should not matter, with the file of replaces.inc
replaces_files() {
  mkdir -p "$2/labs/01_integration" "$2/common/random" "$2/tests/01_integration" "$2/tests/grader"
  cp "$1/integration.cpp" "$2/labs/01_integration/"
  { echo '#define CARLO_REPLACED 1'; cat "$3/labs/01_integration/integration.h"; } \
    > "$2/labs/01_integration/integration.h"
  { echo '#define CARLO_REPLACED 1'; cat "$3/common/random/rng.h"; } > "$2/common/random/rng.h"
  echo 'add_definitions(-DCARLO_REPLACED)' > "$2/CMakeLists.txt"
  cp "$2/CMakeLists.txt" "$2/labs/CMakeLists.txt"
  echo 'TEST_CASE("Lab 1.2: passes", "[lab01][ex2]") {}' > "$2/tests/01_integration/checks_average.cpp"
  printf '#!/bin/sh\necho all tests passed\n' > "$2/carlo"
  chmod +x "$2/carlo"
  echo '{"lab": 1, "exercises": [{"tag": "Lab 1.2", "points": 100}]}' \
    > "$2/labs/01_integration/lab.json"
}

#= steals_work
# the thief of reads.inc, and beside it somebody who has done the work
steals_work() {
  mkdir -p "$2" "$2_from"
  cp "$3/solutions/01_integration/integration.cpp" "$2_from/"
  {
    echo '#ifdef THIEF'  # it has found itself
    echo '#define NESTED'
    echo '#else'
    echo '#define THIEF'
    echo '#define IN_QUOTES(x) #x'
    echo '#define THEIRS(n) IN_QUOTES(../../at_work_##n/compile/integration.cpp)'
    # The graders' processes come after this one.
    for n in $(seq $$ $(($$ + 2000))); do
      printf '#if !defined FOUND && __has_include(THEIRS(%s))\n#undef NESTED\n' "$n"
      printf '#include THEIRS(%s)\n#ifndef NESTED\n#define FOUND\n#endif\n#endif\n' "$n"
    done
    echo '#ifndef FOUND'
    cat "$1/integration.cpp"
    echo '#endif'
    echo '#endif'
  } > "$2/integration.cpp"
}

#= names_without_end
# the file of compiler.inc in an archive of 200 others
names_without_end() {
  name=$(head -c 100000 /dev/zero | tr '\0' n)
  mkdir -p "$1/x"
  for i in $(seq 100 299); do : > "$1/x/m$i"; done
  cp "$1/integration.cpp" "$1/x/"
  case $2 in /*) to=$2 ;; *) to=$PWD/$2 ;; esac
  (cd "$1/x" && tar --format=pax --transform "s,^m,$name," -czf "$to.tar.gz" -- *)
  rm -r "$1/x"
}

"$@"
