#!/usr/bin/env bash
# load_test.sh SOURCE BUILD [COPIES JOBS ...]: a class of right answers, mistakes and attacks in lab
# 1, COPIES of each (8: 64 submissions), graded with each number of JOBS at a time (1 8 32 64),
# then while other programs take the memory, then killed (kill -9) and restarted: the marks are
# those deserved, and class.csv has the same bytes each time. As root also on a nearly full volume:
# those who get marks there get the same, the others none, and all get them in a second run with
# room.
set -euo pipefail
source=$(readlink -f "$1")
build=$(readlink -f "$2")
copies=${3:-8}
shift $(($# < 3 ? $# : 3))
jobs=("$@")
[ ${#jobs[@]} != 0 ] || jobs=(1 8 32 64)
solution=$source/solutions/01_integration/integration.cpp

scratch=$(mktemp -d)
chmod 711 "$scratch"
export TMPDIR=$scratch/tmp
mkdir -m 711 "$TMPDIR"
hogs=()
cleanup() {
  [ ${#hogs[@]} = 0 ] || kill -9 "${hogs[@]}" 2>/dev/null || true
  if mountpoint -q "$scratch/small"; then umount -l "$scratch/small"; fi
  rm -rf "$scratch"
}
trap cleanup EXIT

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}

# Eight kinds, half of them right, to show what an attack takes from others.
make_class() {
  local i kind
  for i in $(seq "$copies"); do
    for kind in right_a right_b right_c stub mistaken broken thief hog; do
      mkdir -p "$1/$kind$i"
      cp "$solution" "$1/$kind$i/integration.cpp"
    done
    # No two right answers are identical.
    for kind in a b c; do echo "// $i $kind" >>"$1/right_$kind$i/integration.cpp"; done
    cp "$source/labs/01_integration/integration.cpp" "$1/stub$i/"
    "$source/tests/grader/mistakes.awk" put "$1/mistaken$i/integration.cpp" \
      "$source/tests/01_integration/mistakes/average.txt" average_by_n_plus_one
    echo '#error No space left on device, vfork: Resource temporarily unavailable' \
      >>"$1/broken$i/integration.cpp"
    sed -i "1i #include \"$solution\"" "$1/thief$i/integration.cpp"
    # Takes all the disk, processes and memory it can get, then answers correctly.
    sed -i -e '1i #include <fcntl.h>\n#include <unistd.h>\n#include <vector>' \
      -e 's|^double average(.*{$|&\n  static const bool once = [] {\n    const int fd = ::open("large", O_WRONLY \| O_CREAT, 0600);\n    (void)::posix_fallocate(fd, 0, 8 << 20);\n    for (int i = 0; i < 40; ++i)\n      if (::fork() == 0) { ::sleep(1); ::_exit(0); }\n    return std::vector<char>(100 << 20, 1)[7] == 1;\n  }();\n  if (!once) return 0;|' \
      "$1/hog$i/integration.cpp"
  done
}

# expected NAME: prints the total and the status of a submission.
expected() {
  local i
  for i in $(seq "$copies"); do
    printf '%s,20,20,graded\n' "hog$i" "right_a$i" "right_b$i" "right_c$i"
    printf '%s,16,20,graded\n' "mistaken$i"
    printf '%s,0,20,graded\n' "stub$i"
    printf '%s,0,20,lab 1 does not compile\n' "broken$i" "thief$i"
  done | LC_ALL=C sort
}

marks() { tail -n +2 "$1/class.csv" | cut -d, -f1,10-12 | LC_ALL=C sort; }

echo 'a secret of this test' >"$scratch/secret"
chmod 600 "$scratch/secret"
make_class "$scratch/class"
grade=("$build/bin/carlo_grade" --tree "$source" --build "$build" "$scratch/class" --labs 1
  --secret-file "$scratch/secret")

# run NAME JOBS: grades into NAME; the marks must be those deserved.
run() {
  local start=$SECONDS
  "${grade[@]}" -j "$2" -o "$scratch/$1" >"$scratch/$1.log" 2>&1 ||
    fail "$1: the grader ended with $?: $(tail -n 3 "$scratch/$1.log")"
  printf '%s: %d s, %s\nSHA-256 of class.csv: %s\n' "$1" "$((SECONDS - start))" "$(head -n 1 "$scratch/$1.log")" \
    "$(sha256sum <"$scratch/$1/class.csv" | cut -d' ' -f1)"
  diff <(expected) <(marks "$scratch/$1") || fail "$1: these are not the marks deserved"
  [ -e "$scratch/first.csv" ] || cp "$scratch/$1/class.csv" "$scratch/first.csv"
  cmp "$scratch/first.csv" "$scratch/$1/class.csv" || fail "$1: class.csv has other bytes"
}

for count in "${jobs[@]}"; do run "jobs_$count" "$count"; done

# Half of the remaining memory, in programs that touch it again and again.
half=$(awk '/^MemAvailable/ { print int($2 / 2048) }' /proc/meminfo)
for _ in 1 2; do
  perl -e '$x = "x" x ($ARGV[0] << 19); while (1) { for (my $i = 0; $i < length $x; $i += 4096)
    { substr($x, $i, 1) = "y" } sleep 1 }' "$half" &
  hogs+=($!)
done
run memory "${jobs[-1]}"
kill -9 "${hogs[@]}"
wait "${hogs[@]}" 2>/dev/null || true
hogs=()

setsid "${grade[@]}" -j "${jobs[-1]}" -o "$scratch/killed" >/dev/null 2>&1 &
grader=$!
for _ in $(seq 3000); do
  [ "$(find "$scratch/killed" -name record.json 2>/dev/null | wc -l)" -lt 3 ] || break
  sleep 0.1
done
kill -9 "$grader"
wait "$grader" 2>/dev/null || true
[ ! -e "$scratch/killed/class.csv" ] || fail "it was done before it could be killed"
for _ in $(seq 200); do
  pgrep -f "$scratch/(class|tmp)" >/dev/null || break
  sleep 0.1
done
! pgrep -fa "$scratch/(class|tmp)" || fail "these outlived the grader"
run killed "${jobs[-1]}"

if [ "$(id -u)" = 0 ] && mkdir "$scratch/small" &&
  mount -t tmpfs -o size=60M,mode=711 small "$scratch/small" 2>/dev/null; then
  mkdir -m 711 "$scratch/small/tmp"
  # Fills up while it runs, then is emptied again.
  head -c 30M /dev/zero >"$scratch/small/filler"
  TMPDIR=$scratch/small/tmp "${grade[@]}" -j "${jobs[-1]}" -o "$scratch/small/out" \
    >"$scratch/full.log" 2>&1 &
  grader=$!
  sleep 4
  head -c 100M /dev/zero >>"$scratch/small/filler" 2>/dev/null || true
  wait "$grader" || echo "on a full volume: exit code $?"
  if [ -s "$scratch/small/out/class.csv" ]; then
    marks "$scratch/small/out" | grep -v ',,20,' |
      diff <(expected) - | grep '^>' && fail "on a full volume these marks are not those deserved"
  fi
  rm "$scratch/small/filler"
  export TMPDIR=$scratch/small/tmp
  run small/out "${jobs[0]}"
fi
echo passed
