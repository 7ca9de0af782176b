// Workers that misbehave: each gives the right verdict in time and leaves no process behind, at
// every level of the sandbox.

#include "cli/error.h"
#include "grader/judge/run.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>

using namespace carlo::grader;
using Clock = std::chrono::steady_clock;

namespace {

/// What run_probe() threw, or passed with an empty message.
struct Result {
  Status status = Status::passed;
  std::string message, printed;
  double seconds = 0;
};

/// Short for workers that hang, long for those that end by themselves, however busy the machine is.
Result run(Level level, const std::string& probe, bool hangs = false) {
  Limits limits;
  limits.deadline = std::chrono::milliseconds(hangs ? 1500 : 60000);
  Result result;
  const Clock::time_point start = Clock::now();
  try {
    run_probe(Sandbox(FIXTURE_WORKER, level), probe, {}, {}, limits);
  } catch (const ProbeFailure& failure) {
    result = {failure.status, failure.what(), failure.printed};
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

/// The levels that work on this machine.
std::vector<Level> levels() {
  std::vector<Level> list{Level::limits};
  if (Sandbox::strongest(FIXTURE_WORKER).level() == Level::bubblewrap) {
    list.push_back(Level::bubblewrap);
  }
  return list;
}

bool no_child_left() {
  return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a good worker's values arrive as they were sent", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Params params{.seed = 1, .n = 7, .numbers = {{"x", 0.1}}};
  const Rows rows = run_probe(Sandbox(FIXTURE_WORKER, level), "good", params, {2, 3}, {});
  CHECK(rows.values == std::vector<double>{1, 0.1, 7, 4, 5, 6});
  CHECK(no_child_left());
}

TEST_CASE("misbehaviour gives its verdict in time and leaves no process", "[worker]") {
  struct Case {
    const char* probe;
    Status status;
    const char* message;
  };
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Case expected = GENERATE(
      Case{"exit 0", Status::crashed, "ended itself (exit code 0) before"},
      Case{"_exit 0", Status::crashed, "ended itself (exit code 0) before"},
      Case{"quick_exit 0", Status::crashed, "ended itself (exit code 0) before"},
      Case{"exit 3", Status::crashed, "exit code 3"}, Case{"abort", Status::crashed, "abort"},
      Case{"hang", Status::timeout, "not done after 1.5 seconds"},
      Case{"stops itself", Status::timeout, "not done after 1.5 seconds"},
      Case{"one byte, then silence", Status::timeout, "not done after 1.5 seconds"},
      Case{"flood stdout", Status::crashed, "printed without end"},
      Case{"flood result", Status::crashed, "sent more than any answer holds"},
      Case{"truncated frame", Status::crashed, "cut short"},
      Case{"frame, then crash", Status::crashed, "abort"},
      Case{"a frame before the frame", Status::crashed, "cut short or no answer"},
      Case{"NaN", Status::failed, "NaN"}, Case{"infinity", Status::failed, "infinite"},
      Case{"empty", Status::failed, "expected 1 x 1"},
      Case{"good", Status::crashed, "needs the number \"x\""},
      Case{"no such probe", Status::crashed, "exit code 1"},
      Case{"throws", Status::crashed, "n must be positive"},
      Case{"throws an int", Status::crashed, "no std::exception"},
      Case{"not implemented", Status::not_implemented, "not implemented"},
      Case{"survivor", Status::passed, ""});
  INFO(expected.probe << " at level " << to_string(level));
  const Result result = run(level, expected.probe, expected.status == Status::timeout);
  INFO(result.message << " | " << result.printed);
  CHECK(result.status == expected.status);
  CHECK(has(result.message, expected.message));
  CHECK(result.seconds < 60);  // the deadline, and time for a busy machine to clean up
  CHECK(no_child_left());
}

TEST_CASE("a crash names its signal", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Result result = run(level, "crash");
  CHECK(result.status == Status::crashed);
  // Under AddressSanitizer the worker reports the fault itself and exits with 1.
  CHECK((address_sanitizer() || has(result.message, "segmentation fault")));
}

TEST_CASE("writing next to an array is noticed in every build", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  for (const char* probe : {"writes past an array", "writes before an array"}) {
    const Result result = run(level, probe);
    INFO(probe << ": " << result.message << " | " << result.printed);
    CHECK(result.status == Status::crashed);
    // Under AddressSanitizer the sanitizer itself reports it.
    CHECK((address_sanitizer() || has(result.printed, "was overwritten")));
  }
}

TEST_CASE("100 GB are not to be had", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  Limits limits;
  limits.memory_bytes = std::size_t{256} << 20;
  const Sandbox sandbox(FIXTURE_WORKER, level);
  CHECK_THROWS_AS(run_probe(sandbox, "allocates 100 GB", {}, {}, limits), ProbeFailure);
  CHECK(no_child_left());
}

TEST_CASE("what a program printed before it failed is shown, cut to size", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Result flood = run(level, "flood stdout");
  CHECK(flood.printed.size() == Limits{}.output_kept);
  const Result crash = run(level, "no such probe");
  CHECK(has(crash.printed, "no probe"));
  CHECK(run(level, "prints").status == Status::passed);
}

TEST_CASE("a worker inherits four descriptors and no environment", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Sandbox sandbox(FIXTURE_WORKER, level);
  const Rows open = run_probe(sandbox, "open descriptors", {}, {}, {});
  CHECK(open.values[0] == 4);
  const Rows variables = run_probe(sandbox, "environment", {}, {}, {});
  CHECK(variables.values[0] <= 4);  // PATH, LANG; PWD from bubblewrap; ASAN_OPTIONS
}

TEST_CASE("inside bubblewrap there is no disk to read", "[worker]") {
  if (levels().size() < 2) SKIP("bubblewrap does not work here");
  const Sandbox sandbox(FIXTURE_WORKER, Level::bubblewrap);
  CHECK(run_probe(sandbox, "reads the disk", {}, {}, {}).values[0] == 0);
}

TEST_CASE("a worker that is no program is an error", "[worker]") {
  CHECK_THROWS_AS(Sandbox("/nowhere/worker", Level::limits), carlo::Error);
  CHECK_THROWS_AS(Sandbox("/tmp", Level::limits), carlo::Error);
}

TEST_CASE("seeds follow from the run, the test and the probe's place in it", "[run]") {
  const auto seeds = [](std::uint64_t seed, const std::string& test) {
    Run run(Sandbox(FIXTURE_WORKER, Level::limits), seed, {});
    run.begin_test(test);
    const Rows first = run.probe("echo seed", {}, {});
    const Rows second = run.probe("echo seed", {}, {});
    return std::pair(first.values[0], second.values[0]);
  };
  const auto base = seeds(1, "Lab 0.1: it works");
  CHECK(base == seeds(1, "Lab 0.1: it works"));
  CHECK(base.first != base.second);
  CHECK(base.first != seeds(2, "Lab 0.1: it works").first);
  CHECK(base.first != seeds(1, "Lab 0.1: it works well").first);
}
