#include "course/report/crash_note.h"

#include "course/report/say_in_handler.h"

#include <algorithm>
#include <array>
#include <csignal>

namespace carlo {
namespace {

// Prepared in advance: a signal handler may call next to nothing.
std::array<char, 256> title{};
std::array<char, 16384> stack{};

extern "C" void crashed(int signal) {
  if (title[0] != '\0') {
    say_in_handler("\nThe program crashed in the experiment\n  \"");
    say_in_handler(title.data());
    say_in_handler("\"\n");
  }
  ::raise(signal);  // the handler is reset: the system ends the program
}

constexpr bool sanitized =
#if defined(__SANITIZE_ADDRESS__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

}  // namespace

void report_crashes() {
  if (sanitized) return;
  // The handler's own stack: endless recursion has used up the other.
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  ::sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_handler = crashed;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_ONSTACK | SA_NODEFER;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    ::sigaction(signal, &action, nullptr);
}

void note_experiment(std::string_view name) {
  const std::size_t length = std::min(name.size(), title.size() - 1);
  std::copy_n(name.begin(), length, title.begin());
  title.at(length) = '\0';
}

std::string_view noted_experiment() {
  return title.data();
}

}  // namespace carlo
