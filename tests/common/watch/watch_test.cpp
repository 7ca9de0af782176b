// ./carlo watch, with a simulated build and judge: on a pseudoterminal (keys, crashes) and without
// one. Nothing here depends on how long anything takes.

#include "course/watch/child.h"
#include "course/watch/file_events.h"
#include "support/atomic_file.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

constexpr const char* lab_text = R"({"lab": 1, "name": "demo", "title": "Demo", "exercises": [
  {"tag": "Lab 1.1", "title": "First", "points": 2, "functions": ["f"],
   "hints": ["the nudge of one", "the plan of one"]},
  {"tag": "Lab 1.2", "title": "Second, which is called a good deal more than fits into a narrow terminal's line",
   "points": 3, "functions": ["g"],
   "hints": ["the nudge of two", "the plan of two"]}]})";

// If demo.cpp contains "broken" it does not compile; if it contains "slow" it takes a second.
constexpr const char* ninja_text = R"sh(#!/bin/sh
file=$(dirname "$2")/labs/01_demo/demo.cpp
! grep slow "$file" >/dev/null || sleep 1
grep -n broken "$file" >/dev/null || exit 0
echo "$file:3:5: error: 'broken' was not declared in this scope"
echo "    3 |     broken"
exit 1
)sh";

// An exercise passes if its file contains "good N"; if both are requested, both are judged.
constexpr const char* judge_text = R"sh(#!/bin/sh
while [ $# -gt 0 ]; do
  case $1 in --lab) lab=$2 ;; --json) json=$2 ;; --exercise) only=$2 ;; esac
  shift 2
done
file=$(dirname "$lab")/demo.cpp
entry() {
  status=failed points=0
  if grep -q "good $1" "$file"; then status=passed points=$2; fi
  printf '{"tag": "Lab %s", "title": "T", "points": %s, "max": %s, ' $1 $points $2
  printf '"status": "%s", "diagnoses": [], "unsound": [], "missing": [], "begun": false, ' $status
  printf '"tests": [{"sentence": "verdict of %s: %s", "status": "%s", ' $1 $status $status
  printf '"aspect": "correctness", "problem": "", "printed": "", "lost_lines": 0, '
  printf '"lacks_line": false, "skipped": false, "needs": "", "verdicts": []}]}'
}
case $only in
  1.1) list=$(entry 1.1 2) ;;
  1.2) list=$(entry 1.2 3) ;;
  *) list="$(entry 1.1 2), $(entry 1.2 3)" ;;
esac
printf '{"lab": 1, "title": "T", "whole": true, "seed": "1", "usual_seed": true, ' >"$json"
printf '"sandbox": "s", "cut": false, "exercises": [%s]}\n' "$list" >>"$json"
)sh";

class Tree {
 public:
  Tree() : root_(fs::temp_directory_path() / fmt::format("carlo_watched_{}", ::getpid())) {
    fs::create_directories(root_ / "labs/01_demo");
    fs::create_directories(root_ / "build/bin");
    fs::create_directories(root_ / "programs");
    write_file(root_ / "labs/01_demo/lab.json", lab_text);
    program(root_ / "programs/ninja", ninja_text);
    program(root_ / "build/bin/lab01_judge", judge_text);
    program(root_ / "build/bin/lab01_worker", "#!/bin/sh\n");
    fs::create_directories(root_ / "common/course");
    fs::create_symlink(CARLO_IN_TURN, root_ / "common/course/in_turn.sh");
    edit("bad", "bad");
  }
  ~Tree() {
    std::error_code ec;
    fs::remove_all(root_, ec);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  void edit(const std::string& first, const std::string& second) const {
    write_file(root_ / "labs/01_demo/demo.cpp",
               fmt::format("// Lab 1.1 ----\n{}\n// Lab 1.2 ----\n{}\n", first, second));
  }
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"/usr/bin/env",
                                   "PATH=" + (root_ / "programs").string() + ":/usr/bin:/bin",
                                   "TERM=xterm",
                                   "NO_COLOR=1",
                                   CARLO_WATCH,
                                   "--root",
                                   root_.string(),
                                   "--build",
                                   (root_ / "build").string(),
                                   "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  bool kept_verdicts() const { return fs::exists(root_ / ".carlo/verdicts.json"); }

 private:
  static void program(const fs::path& file, const std::string& text) {
    write_file(file, text);
    fs::permissions(file, fs::perms::owner_all);
  }
  fs::path root_;
};

/// A program on its own pseudoterminal.
class Terminal {
 public:
  explicit Terminal(const std::vector<std::string>& command) {
    winsize size{};
    size.ws_row = 40;
    size.ws_col = 100;
    pid_ = ::forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      std::vector<std::string> words = command;
      std::vector<char*> argv;
      for (std::string& word : words)
        argv.push_back(word.data());
      argv.push_back(nullptr);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  ~Terminal() {
    if (pid_ > 0) (void)end(SIGKILL);
    ::close(fd_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Waits up to a minute for this output (after what was found last); true if it appears.
  bool says(const std::string& text) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (true) {
      const std::size_t at = said_.find(text);
      if (at != std::string::npos) {
        said_.erase(0, at + text.size());
        return true;
      }
      if (std::chrono::steady_clock::now() > deadline || !more()) return false;
    }
  }
  void press(const std::string& keys) const {
    REQUIRE(::write(fd_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
  }
  void signal(int number) const { ::kill(pid_, number); }

  /// Its exit code, or 128 + the signal that ended it, after sending signal `number` if it is not
  /// 0.
  int end(int number = 0) {
    if (number != 0) signal(number);
    while (more()) {
    }
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  /// True if line editing and echo are on, as a shell expects.
  bool as_before() const {
    termios now{};
    return ::tcgetattr(fd_, &now) == 0 && (now.c_lflag & ICANON) != 0 && (now.c_lflag & ECHO) != 0;
  }
  void resize(unsigned short columns, unsigned short rows) const {
    winsize size{};
    size.ws_row = rows;
    size.ws_col = columns;
    ::ioctl(fd_, TIOCSWINSZ, &size);
  }

 private:
  bool more() {
    pollfd wait{fd_, POLLIN, 0};
    if (::poll(&wait, 1, 60'000) <= 0) return false;
    std::array<char, 4096> buffer{};
    const ssize_t got = ::read(fd_, buffer.data(), buffer.size());
    if (got <= 0) return false;
    said_.append(buffer.data(), static_cast<std::size_t>(got));
    return true;
  }

  int fd_ = -1;
  pid_t pid_ = -1;
  std::string said_;
};

/// Reads lines of a program without a terminal, up to one that contains `text`.
bool comes_to_say(Child& child, const std::string& text) {
  while (child.output().find(text) == std::string::npos) {
    pollfd wait{child.fd(), POLLIN, 0};
    if (::poll(&wait, 1, 60'000) <= 0 || child.ended()) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("at a terminal: break, mend, hint, next, list, all and quit", "[watch]") {
  const Tree tree;
  Terminal terminal(tree.command());
  REQUIRE(terminal.says("verdict of 1.1: failed"));
  REQUIRE(terminal.says("h hint"));
  CHECK_FALSE(terminal.as_before());
  tree.edit("broken", "bad");
  REQUIRE(terminal.says("the code does not compile"));
  REQUIRE(terminal.says("labs/01_demo/demo.cpp:3:5: error: 'broken' was not declared"));
  tree.edit("good 1.1", "bad");
  REQUIRE(terminal.says("✓ Lab 1.1, First: 2 of 2 points"));
  REQUIRE(terminal.says("Next: Lab 1.2, Second"));
  CHECK(tree.kept_verdicts());
  terminal.press("h");
  REQUIRE(terminal.says("the nudge of one"));
  terminal.press("h");
  REQUIRE(terminal.says("the plan of one"));
  terminal.press("n");
  REQUIRE(terminal.says("verdict of 1.2: failed"));
  tree.edit("good 1.1", "good 1.2");
  REQUIRE(terminal.says("Lab 1 is done."));
  terminal.press("p");
  REQUIRE(terminal.says("✓ Lab 1.1, First: 2 of 2 points"));
  terminal.press("l");
  REQUIRE(terminal.says("✓ 1.2  Second"));
  tree.edit("good 1.1", "bad again");
  REQUIRE(terminal.says("verdict of 1.2: failed"));
  tree.edit("good 1.1 too", "good 1.2");  // both changed at once: both are judged
  REQUIRE(terminal.says("✓ Lab 1.1, First: 2 of 2 points"));
  REQUIRE(terminal.says("✓ Lab 1.2, Second"));
  tree.edit("bad once more", "bad once more");
  REQUIRE(terminal.says("verdict of 1.1: failed"));
  REQUIRE(terminal.says("verdict of 1.2: failed"));
  tree.edit("good 1.1, slow", "bad once more");
  REQUIRE(terminal.says("building for Lab 1.1"));
  tree.edit("good 1.1, slow", "good 1.2");  // changed before the first was judged: both are judged
  REQUIRE(terminal.says("✓ Lab 1.1, First: 2 of 2 points"));
  REQUIRE(terminal.says("✓ Lab 1.2, Second"));
  tree.edit("broken, slow",
            "good 1.2");  // the last good result is no longer shown as if it belonged to this text
  REQUIRE(terminal.says("First: 2 of 2 points, before this change"));
  REQUIRE(terminal.says("the code does not compile"));
  tree.edit("bad at last", "bad at last");
  REQUIRE(terminal.says("verdict of 1.2: failed"));
  terminal.press("a");
  REQUIRE(terminal.says("✗ 1.2  Second"));
  terminal.resize(60, 20);
  REQUIRE(terminal.says("✗ 1.2  Second, "));
  REQUIRE(terminal.says("…  0 of 3  not right yet"));
  terminal.press("\x1b[A");  // an arrow is none of our keys
  terminal.press("q");
  CHECK(terminal.end() == 0);
  CHECK(terminal.as_before());
}

TEST_CASE("the terminal is as it was after a signal and after a crash", "[watch]") {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGABRT}) {
    const Tree tree;
    Terminal terminal(tree.command());
    REQUIRE(terminal.says("h hint"));
    CHECK_FALSE(terminal.as_before());
    CHECK(terminal.end(number) == 128 + number);
    CHECK(terminal.as_before());
  }
}

TEST_CASE("Ctrl-C typed ends it; another size is another drawing", "[watch]") {
  const Tree tree;
  Terminal terminal(tree.command());
  REQUIRE(terminal.says("h hint"));
  terminal.resize(30, 20);
  REQUIRE(terminal.says("v in full"));
  terminal.press("\x03");
  CHECK(terminal.end() == 128 + SIGINT);
  CHECK(terminal.as_before());
}

TEST_CASE("without a terminal: plain lines, by events and by looking", "[watch]") {
  for (const bool look : {false, true}) {
    const Tree tree;
    Child child(
        tree.command(look ? std::vector<std::string>{"--poll"} : std::vector<std::string>{}));
    REQUIRE(comes_to_say(child, "verdict of 1.1: failed"));
    tree.edit("broken", "bad");
    REQUIRE(comes_to_say(child, "labs/01_demo/demo.cpp:3:5: error: 'broken'"));
    tree.edit("good 1.1", "bad");
    REQUIRE(comes_to_say(child, "Lab 1.1, First: 2 of 2 points"));
    tree.edit("good 1.1", "good 1.2");
    REQUIRE(comes_to_say(child, "Lab 1 is done."));
    CHECK(child.output().find('\x1b') == std::string::npos);
    CHECK((child.output().find("looking every") != std::string::npos) == look);
  }
}

TEST_CASE("files that are written anew, replaced or touched are noticed by looking", "[watch]") {
  const Tree tree;
  const fs::path folder = fs::temp_directory_path() / fmt::format("carlo_watched_{}", ::getpid());
  FileEvents events({folder / "labs/01_demo"}, true);
  CHECK(events.polls());
  CHECK_FALSE(events.happened());
  tree.edit("good 1.1", "bad");
  CHECK(events.happened());
  CHECK_FALSE(events.happened());
}
