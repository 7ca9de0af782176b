#include "grader/worker/full_stack.h"

#include "course/report/signal_handler.h"
#include "grader/protocol/frame.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <ucontext.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace carlo::grader {
namespace {

// Prepared in advance: a signal handler may call next to nothing.
std::array<char, 64> line{};
std::size_t line_length = 0;
std::uintptr_t lowest = 0;  ///< about where the stack's limit is
pthread_t main_thread{};    ///< only its stack is known

/// The stack pointer at a signal; 0 on processors where we do not know how to ask.
std::uintptr_t stack_pointer([[maybe_unused]] const void* context) {
#if defined(__x86_64__)
  return static_cast<std::uintptr_t>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  return static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.sp);
#else
  return 0;
#endif
}

/// Whether the kernel refused an access to the current function's part of the stack, and that part
/// reaches the limit: the end of a recursion, or of a function with a large array.
bool is_full(const siginfo_t& info, const void* context) {
  constexpr std::uintptr_t arguments = 256 << 10;  // and the environment, above main()'s variables
  constexpr std::uintptr_t below_pointer = 256;    // a call's return address, a leaf's variables
  const std::uintptr_t pointer = stack_pointer(context);
  const auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
  const bool by_access = info.si_code == SEGV_MAPERR || info.si_code == SEGV_ACCERR;
  return by_access && pthread_equal(pthread_self(), main_thread) != 0 && pointer != 0 &&
         address < lowest + arguments && address + below_pointer >= pointer;
}

extern "C" void tell_full_stack(int signal, siginfo_t* info, void* context) {
  if (is_full(*info, context)) say_in_handler({line.data(), line_length});
  ::raise(signal);  // the handler is reset: the system ends the program
}

}  // namespace

void report_full_stack() {
  rlimit limit{};
  if (sanitizer_reports_crashes || ::getrlimit(RLIMIT_STACK, &limit) != 0) return;
  if (limit.rlim_cur == RLIM_INFINITY) return;
  const auto here = reinterpret_cast<std::uintptr_t>(&limit);
  if (limit.rlim_cur > here) return;
  lowest = here - limit.rlim_cur;
  main_thread = pthread_self();
  const double megabytes = static_cast<double>(limit.rlim_cur) / (1 << 20);
  const auto written = fmt::format_to_n(line.data(), line.size(), "{}{:.3g}{}\n", stack_report,
                                        megabytes, stack_report_end);
  line_length = std::min(written.size, line.size());
  struct sigaction action {};
  action.sa_sigaction = tell_full_stack;
  action.sa_flags = SA_SIGINFO;
  handle_crashes(action, {SIGSEGV});
}

}  // namespace carlo::grader
