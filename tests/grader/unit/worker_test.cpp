// Workers that misbehave: each gives the right verdict in time and leaves no process behind, at
// every level of the sandbox.

#include "busy.h"
#include "grader/judge/run.h"
#include "memory_limits.h"
#include "places.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

using namespace carlo;
using namespace carlo::grader;
using namespace grader_test;
using Clock = std::chrono::steady_clock;

namespace {

/// The failure that run_probe() threw; passed with an empty message if it did not throw.
struct Result {
  Status status = Status::passed;
  std::string message, printed;
  double seconds = 0;
  std::size_t lost_lines = 0;
};

/// A short deadline for workers that hang, a long one for those that end by themselves, however
/// busy the machine is.
Result run(Level level, const std::string& probe, bool hangs = false) {
  Limits limits;
  limits.deadline = std::chrono::milliseconds(hangs ? 800 : 60000);
  Result result;
  const Clock::time_point start = Clock::now();
  try {
    run_probe(Worker(fixture_worker(), level), probe, {}, {}, limits);
  } catch (const ProbeFailure& failure) {
    result = {failure.status, failure.what(), failure.printed, 0, failure.lost_lines};
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

bool works(Level level) {
  try {
    const Worker worker(fixture_worker(), level);
    return true;
  } catch (const carlo::Error&) {
    return false;
  }
}

/// Returns the levels that work on this machine.
std::vector<Level> levels() {
  std::vector<Level> list;
  for (const Level level : {Level::limits, Level::user, Level::landlock, Level::bubblewrap}) {
    if (works(level)) list.push_back(level);
  }
  return list;
}

/// Skips a test if the level does not work, and says so.
void need(Level level) {
  if (!works(level)) SKIP("the level \"" << to_string(level) << "\" does not work here");
}

/// Returns the single value of a probe at a level.
double value(Level level, const std::string& probe, const Params& params = {}) {
  return run_probe(Worker(fixture_worker(), level), probe, params, {}, {}).values[0];
}

bool no_child_left() {
  return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

}  // namespace

TEST_CASE("a good worker's values arrive as they were sent", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Params params{.seed = 1, .n = 7, .numbers = {{"x", 0.1}}};
  const Clock::time_point start = Clock::now();
  const Answer rows = run_probe(Worker(fixture_worker(), level), "good", params, {2, 3}, {});
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  CHECK(rows.values == std::vector<double>{1, 0.1, 7, 4, 5, 6});
  CHECK(rows.seed == params.seed);
  CHECK((rows.seconds > 0 && rows.seconds <= seconds));
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
      Case{"exit 0", Status::crashed, "by exit() or the like, before the function returned"},
      Case{"_exit 0", Status::crashed, "by exit() or the like, before the function returned"},
      Case{"quick_exit 0", Status::crashed, "by exit() or the like, before the function returned"},
      Case{"exit 3", Status::crashed, "exit code 3"}, Case{"abort", Status::crashed, "abort"},
      Case{"hang", Status::timeout, "timed out after 0.8 seconds: a loop"},
      Case{"stops itself", Status::timeout, "0.8 seconds, mostly idle"},
      Case{"one byte, then silence", Status::timeout, "timed out after 0.8 seconds"},
      Case{"flood stdout", Status::crashed, "printed more than"},
      Case{"flood result", Status::crashed, "sent more than any answer holds"},
      Case{"truncated frame", Status::crashed, "no complete answer"},
      Case{"frame, then crash", Status::crashed, "abort"},
      Case{"a frame before the frame", Status::crashed, "no complete answer"},
      Case{"NaN", Status::failed, "NaN"}, Case{"infinity", Status::failed, "infinite"},
      Case{"empty", Status::failed, "expected 1 x 1"},
      Case{"good", Status::crashed, "needs the number \"x\""},
      Case{"no such probe", Status::crashed, "exit code 1"},
      Case{"throws", Status::crashed, "n must be positive"},
      Case{"throws an int", Status::crashed, "no std::exception"},
      Case{"not implemented", Status::not_implemented, "not implemented"},
      Case{"survivor", Status::passed, ""});
  INFO(expected.probe << " at level " << to_string(level));
  const Result result =
      again_if_busy([&] { return run(level, expected.probe, expected.status == Status::timeout); });
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
  // Under sanitizers the null pointer is reported before it is used.
  CHECK((address_sanitizer() || has(result.message, "segmentation fault")));
}

TEST_CASE("a full stack is told from other bad accesses", "[worker]") {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur > std::size_t{64} << 20)
    SKIP("stacks have no limit here, or a large one");
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  for (const char* probe : {"recursion too deep", "local array too large"}) {
    // Clang's sanitizer ends without a report where it marks the ends of such an array.
    if (address_sanitizer() && std::string(probe) == "local array too large") continue;
    const Result result = run(level, probe);
    INFO(probe << ": " << result.message << " | " << result.printed);
    CHECK(result.status == Status::crashed);
    CHECK(has(result.message, "it crashed: the stack is full"));
    CHECK(result.printed.empty());
  }
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
  const Worker sandbox(fixture_worker(), level);
  CHECK_THROWS_AS(run_probe(sandbox, "allocates 100 GB", {}, {}, limits), ProbeFailure);
  CHECK(no_child_left());
}

TEST_CASE("the memory limit holds for all processes together", "[worker]") {
  if (address_sanitizer()) SKIP("the sanitizer's own memory cannot be told apart");
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  Limits limits;
  limits.deadline = std::chrono::seconds(60);
  limits.memory_bytes = std::size_t{512} << 20;
  try {
    run_probe(Worker(fixture_worker(), level), "many processes, much memory", {}, {}, limits);
    FAIL("no failure at level " << to_string(level));
  } catch (const ProbeFailure& failure) {
    CHECK(has(failure.what(), "more than 512 MB of memory together"));
  }
  CHECK(no_child_left());
}

TEST_CASE("what a program printed before it failed is shown, cut to size", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Result flood = run(level, "flood stdout");
  CHECK(flood.printed.size() == Limits{}.output_kept);
  CHECK(flood.lost_lines == 0);  // endless, but on one line
  const Result many = run(level, "prints 5000 lines");
  const auto kept =
      static_cast<std::size_t>(std::count(many.printed.begin(), many.printed.end(), '\n'));
  CHECK(kept + 1 + many.lost_lines == 5000);  // one line is cut in the middle
  const Result crash = run(level, "no such probe");
  CHECK(has(crash.printed, "no probe"));
  CHECK(run(level, "prints").status == Status::passed);
}

TEST_CASE("a worker inherits four descriptors and no environment", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const Worker sandbox(fixture_worker(), level);
  const Rows open = run_probe(sandbox, "open descriptors", {}, {}, {});
  CHECK(open.values[0] == 4);
  const Rows variables = run_probe(sandbox, "environment", {}, {}, {});
  // PATH, LANG, TMPDIR; PWD from bubblewrap; the sanitizers' two, if any.
  CHECK(variables.values[0] <= (address_sanitizer() ? 6 : 4));
}

TEST_CASE("no file outside can be read, and none written", "[worker]") {
  const Level level = GENERATE(Level::landlock, Level::bubblewrap);
  need(level);
  CHECK(value(level, "reads the disk") == 0);
  const Worker worker(fixture_worker(), level);
  const Rows written = run_probe(worker, "writes outside", {}, {1, 2}, {});
  CHECK(written.values == std::vector<double>{0, 0});
  for (const std::filesystem::path& folder : {fixture_folder(), std::filesystem::path("/tmp")})
    CHECK_FALSE(std::filesystem::exists(folder / "written_by_a_worker"));
}

TEST_CASE("a worker may write into a folder of its own, which goes with it", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  INFO(to_string(level));
  CHECK(value(level, "writes into its folder") == 1);
  for (const auto& entry : std::filesystem::directory_iterator("/tmp")) {
    const std::string name = entry.path().filename();
    CHECK_FALSE(
        (has(name, "carlo-scratch-") && std::filesystem::exists(entry.path() / "notes.txt")));
  }
}

TEST_CASE("no rights of files can be changed", "[worker]") {
  const Level level = GENERATE(Level::user, Level::landlock, Level::bubblewrap);
  need(level);
  CHECK(value(level, "changes rights") == 0);
}

TEST_CASE("no file outside can be emptied, before version 3 of Landlock neither", "[worker]") {
  const std::string version = GENERATE("1", "2", "3", "99");
  INFO("Landlock " << version);
  need(Level::landlock);
  const std::filesystem::path file = fixture_folder() / "not_to_be_emptied";
  carlo::write_file(file, "something");
  // Writable for everybody: only the sandbox keeps a worker from it.
  std::filesystem::permissions(file, std::filesystem::perms::all);
  ::setenv("CARLO_LANDLOCK_VERSION", version.c_str(), 1);
  const double own = value(Level::landlock, "empties a file");
  ::unsetenv("CARLO_LANDLOCK_VERSION");
  CHECK(own == 1);
  CHECK(std::filesystem::file_size(file) == 9);
}

TEST_CASE("disk is not to be had in one call", "[worker]") {
  const Level level = GENERATE(Level::user, Level::landlock, Level::bubblewrap);
  need(level);
  CHECK(value(level, "takes disk in one call") == 0);
}

TEST_CASE("threads that cannot be started are no proof against whoever starts them", "[worker]") {
  Limits limits;
  limits.deadline = std::chrono::seconds(60);
  const Worker worker(fixture_worker(), Level::limits);
  try {
    run_probe(worker, "no thread left", {}, {}, limits);
    FAIL("an answer");
  } catch (const Error& error) {
    CHECK(has(error.what(), "could not be started"));
  }
  // Too many are detected: by the watcher if the user is not its own.
  limits.processes = 64;
  try {
    run_probe(worker, "many threads", {}, {}, limits);
    FAIL("an answer");
  } catch (const ProbeFailure& failure) {
    CHECK(has(failure.what(), "more than 64 threads"));
  }
}

TEST_CASE("page tables count as memory", "[worker]") {
  if (address_sanitizer()) SKIP("the sanitizer's own memory cannot be told apart");
  Limits limits;
  limits.deadline = std::chrono::seconds(60);
  limits.memory_bytes = std::size_t{300} << 20;
  try {
    run_probe(Worker(fixture_worker(), Level::limits), "many page tables", {}, {}, limits);
    FAIL("an answer");
  } catch (const ProbeFailure& failure) {
    CHECK(has(failure.what(), "of memory together"));
  }
}

TEST_CASE("the disk cannot be filled, by files without a name neither", "[worker]") {
  const Level level = GENERATE(Catch::Generators::from_range(levels()));
  const std::string filling = GENERATE("fills the disk", "fills the disk unseen");
  INFO(filling << " at level " << to_string(level));
  Limits limits;
  limits.deadline = std::chrono::seconds(60);
  limits.scratch_bytes = std::size_t{40} << 20;
  try {
    run_probe(Worker(fixture_worker(), level), filling, {}, {}, limits);
    FAIL("no failure");
  } catch (const ProbeFailure& failure) {
    CHECK(has(failure.what(), "it filled the disk"));
  }
}

TEST_CASE("there is no network and no way to the judge", "[worker]") {
  const Level level = GENERATE(Level::user, Level::landlock, Level::bubblewrap);
  need(level);
  INFO(to_string(level));
  CHECK(value(level, "opens sockets") == 0);
  const auto own = static_cast<double>(::getpid());
  CHECK(value(level, "signals the judge", {.numbers = {{"judge", own}}}) == 0);
  CHECK(value(level, "forbidden calls") == 0);
}

TEST_CASE("a fork bomb ends with its worker", "[worker]") {
  const Level level = GENERATE(Level::user, Level::landlock, Level::bubblewrap);
  need(level);
  const Worker worker(fixture_worker(), level);
  if (!has(worker.sandbox().description(), "own user")) SKIP("no user of its own to count for");
  Limits limits;
  limits.deadline = std::chrono::milliseconds(800);
  limits.processes = 64;
  const bool ended = fails(worker, "forks without end", limits);
  CHECK(ended);
  CHECK(no_child_left());
}

TEST_CASE("a level is known by its name, and said with what it has", "[worker]") {
  for (const Level level : {Level::limits, Level::user, Level::landlock, Level::bubblewrap})
    CHECK(level_of(to_string(level)) == level);
  CHECK_THROWS_AS(level_of("none"), carlo::Error);
  CHECK(Worker(fixture_worker(), Level::limits).sandbox().description() == "limits only");
}

TEST_CASE("a worker that is no program is an error", "[worker]") {
  CHECK_THROWS_AS(Worker("/nowhere/worker", Level::limits), carlo::Error);
  CHECK_THROWS_AS(Worker("/tmp", Level::limits), carlo::Error);
}

TEST_CASE("a worker whose libraries find no memory is the machine's failure", "[worker]") {
  if (address_sanitizer()) SKIP("no limit of the address space then");
  if (!memory_limits_hold()) SKIP("this system has no limits of memory");
  Limits limits;
  limits.memory_bytes = std::size_t{3} << 20;
  try {
    run_probe(Worker(fixture_worker(), Level::limits), "good", {}, {}, limits);
    FAIL("nothing was thrown");
  } catch (const ProbeFailure& failure) {
    FAIL("told as the student's: " << failure.what());
  } catch (const Error& error) {
    CHECK(has(error.what(), "the sandbox cannot begin a program"));
    CHECK(has(error.what(), "loading shared libraries"));
  }
}
