#include "course/report/crash_note.h"

#include "course/report/signal_handler.h"

#include <algorithm>
#include <array>
#include <csignal>

namespace carlo {
namespace {

// Prepared in advance: a signal handler may call next to nothing.
std::array<char, 256> title{};

extern "C" void crashed(int signal) {
  if (title[0] != '\0') {
    say_in_handler("\nThe program crashed in the experiment\n  \"");
    say_in_handler(title.data());
    say_in_handler("\"\n");
  }
  ::raise(signal);  // the handler is reset: the system ends the program
}

}  // namespace

void report_crashes() {
  if (sanitizer_reports_crashes) return;
  struct sigaction action {};
  action.sa_handler = crashed;
  handle_crashes(action, {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT});
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
