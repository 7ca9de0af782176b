// Probes of exercise 2.5: fast darts.

#include "02_pi/reference.h"
#include "grader/worker/probe.h"
#include "pi.h"

#include <csignal>
#include <ctime>

using namespace lab02_tests;
using carlo::grader::RowWriter;

namespace {

/// The processor seconds of this thread, which exclude other programs' turns.
double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// From now on this thread's signals wait, but for those of its own faults: a handler could take
/// time while one of the loops runs and none while the other does.
void hold_signals() {
  sigset_t waiting;
  ::sigfillset(&waiting);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
    ::sigdelset(&waiting, fault);
  ::pthread_sigmask(SIG_SETMASK, &waiting, nullptr);
}

}  // namespace

PROBE("Lab 2.5 count", "hits") {
  const std::int64_t first = params.whole("first");
  return {1, {number(lab02::count_hits(params.seed, first, params.n))}};
}

// Every range of up to params.n darts that begins at darts 0 ... params.n.
PROBE("Lab 2.5 ranges", "hits of range") {
  RowWriter rows;
  for (std::int64_t first = 0; first <= params.n; ++first) {
    for (std::int64_t n = 0; n <= params.n; ++n) {
      rows.add({number(lab02::count_hits(params.seed, first, n))});
    }
  }
  return rows.take();
}

// The two loops take turns, so that a slow moment of the machine affects both. The counts are
// output with the times: neither loop can be optimised away, and the judge sees that both ran.
PROBE("Lab 2.5 speed", "seconds, std::mt19937", "seconds, yours", "hits, std::mt19937",
      "hits, yours") {
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    hold_signals();
    const double start = thread_seconds();
    const std::int64_t plain = plain_loop(params.seed + static_cast<std::uint64_t>(i), params.n);
    const double middle = thread_seconds();
    const std::int64_t fast = lab02::count_hits(params.seed, i * params.n, params.n);
    const double end = thread_seconds();
    rows.add({middle - start, end - middle, number(plain), number(fast)});
  }
  return rows.take();
}
