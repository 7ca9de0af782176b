// Deadlines on machines that are busy or stand still, and those of an exercise.

#include "busy.h"
#include "grader/judge/run.h"
#include "places.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

using namespace carlo;
using namespace carlo::grader;
using namespace grader_test;

TEST_CASE("the probes of an exercise have a time in all", "[run]") {
  Limits limits;
  limits.deadline = std::chrono::milliseconds(400);
  Run run(Worker(fixture_worker(), Level::limits), 1, limits);
  int started = 0;
  for (; started < 100; ++started) {
    run.begin_test("Lab 0.1: it answers in time, each time");
    try {
      run.probe("almost late", {}, {});
    } catch (const ProbeFailure& failure) {
      if (has(failure.what(), "of this exercise have taken")) break;
    } catch (const Error& error) {
      if (has(error.what(), "too busy") && is_busy()) SKIP(error.what());
      throw;
    }
    run.end_test(true);
    if (run.records().back().status == Status::timeout) return;  // a busy machine
  }
  CHECK(started < 30);
}

// The watcher is stopped for longer than the deadline, as in a frozen control group; the probe does
// that, so it is running by then.
TEST_CASE("a deadline leaves out the time for which the grader stood still", "[worker]") {
  const Worker worker(fixture_worker(), Level::limits);
  Limits limits;
  limits.deadline = std::chrono::milliseconds(2500);
  const Params self{.numbers = {{"x", static_cast<double>(::getpid())}}};
  const double seconds = run_probe(worker, "its watcher stands still", self, {}, limits).seconds;
  CHECK(seconds > 4);
}

// Run while other programs keep all processors busy: busy_test.sh, in_line_test.sh.
TEST_CASE("a deadline leaves out the time for which others had the processors", "[.busy]") {
  Limits limits;
  limits.deadline = std::chrono::milliseconds(1200);
  const Worker worker(fixture_worker());
  for (const char* work :
       {"half a second of work", "half a second of work, by one process after another"}) {
    INFO(work);
    Charged charged;
    const double seconds = again_if_busy([&] {
      charged = {};
      return run_probe(worker, work, {}, {}, limits, &charged).seconds;
    });
    CHECK(seconds > 1.2);
    CHECK(charged.seconds < 1.2);
  }
  const bool ended = fails(worker, "hang", limits);
  CHECK(ended);
}

namespace {

/// Returns whether a process that starts a child by vfork() waits, as for a disk, until it ends:
/// not under QEMU.
bool vfork_waits() {
  const auto begun = std::chrono::steady_clock::now();
  // NOLINTNEXTLINE(clang-analyzer-security.insecureAPI.vfork)
  const pid_t child = ::vfork();
  if (child == 0) {
    ::usleep(200'000);
    ::_exit(0);
  }
  const auto took = std::chrono::steady_clock::now() - begun;
  ::waitpid(child, nullptr, 0);
  return took > std::chrono::milliseconds(150);
}

}  // namespace

TEST_CASE("a deadline leaves out the time for which a disk is awaited, twice its length at most",
          "[worker]") {
  if (!vfork_waits()) SKIP("vfork() keeps nobody waiting here");
  Limits limits;
  const Worker worker(fixture_worker(), Level::limits);
  limits.deadline = std::chrono::milliseconds(1200);
  const auto waiting = [](double seconds) { return Params{.numbers = {{"x", seconds}}}; };
  const double waited = again_if_busy(
      [&] { return run_probe(worker, "x seconds of disk", waiting(2), {}, limits).seconds; });
  CHECK(waited > 1.9);
  limits.deadline = std::chrono::milliseconds(300);
  const bool ended = fails(worker, "x seconds of disk", limits, waiting(60));
  CHECK(ended);
}

TEST_CASE("seeds follow from the run, the test and the probe's place in it", "[run]") {
  const auto seeds = [](std::uint64_t seed, const std::string& test) {
    Run run(Worker(fixture_worker(), Level::limits), seed, {});
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
