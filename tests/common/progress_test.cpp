// The output of a progress line at a terminal, and elsewhere.

#include "support/progress.h"

#include <catch2/catch_test_macros.hpp>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

using namespace std::chrono_literals;

namespace {

/// Reads to the end, at which a terminal reports an error, and closes the file.
std::string all_from(int file) {
  std::string text;
  std::array<char, 4096> block{};
  for (ssize_t got = 0; (got = ::read(file, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(got));
  ::close(file);
  return text;
}

/// Returns what `work` writes to stderr, a terminal, in a separate process.
template <class Work>
std::string at_terminal(const Work& work) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  REQUIRE(child >= 0);
  if (child == 0) {
    ::setenv("TERM", "xterm", 1);
    work();
    ::_exit(0);
  }
  std::string said = all_from(terminal);
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
  return said;
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a line of progress that stands still says so, and for how long", "[progress]") {
  const std::string said = at_terminal([] {
    carlo::Progress progress("lab 01", true);
    progress.report_stalls();
    progress.update(0.5);
    std::this_thread::sleep_for(6s);
  });
  CHECK(has(said, "50 %"));
  CHECK(has(said, "nothing new for 4 s: a loop without end?"));
}

TEST_CASE("a line of progress that moves, or is finished, tells no stall", "[progress]") {
  const std::string said = at_terminal([] {
    carlo::Progress progress("lab 01", true);
    progress.report_stalls();
    for (int i = 0; i < 20; ++i) {
      progress.update(i / 20.0);
      std::this_thread::sleep_for(50ms);
    }
    progress.finish();
    std::this_thread::sleep_for(6s);
  });
  CHECK(has(said, " left"));
  CHECK_FALSE(has(said, "nothing new"));
}

TEST_CASE("the time that is left falls while a large step of the work goes on", "[progress]") {
  carlo::RemainingTime time;
  CHECK_FALSE(time.estimate(3).has_value());
  time.update(0.125, 3);
  CHECK(time.estimate(3).value() == 21);
  CHECK(time.estimate(5).value() == 19);
  // The second step is late: were it to end now, six of eight would be to come.
  CHECK(time.estimate(12).value() == 36);
  time.update(0.25, 12);
  CHECK(time.estimate(12).value() == 36);
  time.update(0.25, 13);  // nothing new
  CHECK(time.estimate(13).value() == 35);
  time.update(0.875, 30);
  CHECK(time.estimate(31).value() > 0);
}

TEST_CASE("without a terminal there is a line now and then, and none after the end", "[progress]") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
    {
      carlo::Progress short_one("short", true, 1h);
      short_one.update(0.5);
    }
    carlo::Progress quiet("quiet", false, 1ms);
    // Long enough for lines on a machine that is busy.
    carlo::Progress progress("rendering", true, 20ms);
    std::this_thread::sleep_for(1s);
    progress.update(0.25);
    std::this_thread::sleep_for(1s);  // nothing new, but lines
    progress.finish();
    std::this_thread::sleep_for(200ms);
    ::_exit(0);
  }
  ::close(ends[1]);
  const std::string said = all_from(ends[0]);
  ::waitpid(child, nullptr, 0);
  CHECK(has(said, "rendering: 0 %, estimating\n"));
  CHECK(has(said, "rendering: 25 %, "));
  CHECK(said.ends_with(" left\n"));
  CHECK_FALSE(has(said, "short"));
  CHECK_FALSE(has(said, "quiet"));
}
