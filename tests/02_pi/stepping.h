#pragma once

// Single-steps a thread through its code, waiting at each instruction until another thread has made
// progress: what two threads may do to each other between two instructions then happens for
// certain, even on one processor, instead of once in a million runs. The processor itself stops the
// thread (its trap flag), so that any code can be stepped. On processors other than x86-64 the
// thread runs normally.

#include <ucontext.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace lab02_tests::stepping {

/// How long an instruction waits for others to proceed, in nanoseconds, and how often in all it may
/// do so in vain: while the stepped thread holds a lock, the others may be waiting for it.
constexpr std::int64_t patience = 1'000'000;
constexpr int most_in_vain = 100;

namespace detail {

inline thread_local bool led = false;
inline std::atomic<std::int64_t> others_went_on = 0;
inline std::atomic<int> in_vain = 0;

inline std::int64_t nanoseconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

inline void wait_for_others() {
  const std::int64_t before = others_went_on, start = nanoseconds();
  while (others_went_on == before) {
    if (nanoseconds() - start > patience) {
      ++in_vain;
      return;
    }
    constexpr timespec moment{0, 1000};
    ::nanosleep(&moment, nullptr);
  }
}

#if defined(__x86_64__)
/// Called after each instruction of a thread whose trap flag is set. Everything here is safe in a
/// signal handler.
inline void trapped(int, siginfo_t*, void* context) {
  const int error = errno;
  if (led && in_vain < most_in_vain) {
    wait_for_others();
  } else {
    constexpr greg_t trap_flag = 0x100;
    static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~trap_flag;
  }
  errno = error;
}
#endif

}  // namespace detail

/// Call once, before the others. The previous handler of SIGTRAP is not restored: a thread that
/// somebody left running may still be stepped.
inline void prepare() {
#if defined(__x86_64__)
  struct sigaction action {};
  action.sa_sigaction = &detail::trapped;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGTRAP, &action, nullptr);
#endif
}

/// Steps this thread from here to its end_here().
inline void begin_here() {
  detail::led = true;
#if defined(__x86_64__)
  // The flags are pushed below the red zone of the stack.
  asm volatile(
      "lea -128(%%rsp), %%rsp\n\t"
      "pushfq\n\t"
      "orq $0x100, (%%rsp)\n\t"
      "popfq\n\t"
      "lea 128(%%rsp), %%rsp"
      :
      :
      : "memory", "cc");
#endif
}
inline void end_here() {
  detail::led = false;
}

/// Called by the others: they have made progress.
inline void went_on() {
  ++detail::others_went_on;
}

}  // namespace lab02_tests::stepping
