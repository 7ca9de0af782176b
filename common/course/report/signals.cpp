#include "course/report/signals.h"

#include "course/report/signal_handler.h"

#include <algorithm>
#include <array>
#include <atomic>
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

struct sigaction before {};
std::string advice;  // of the current note: does not change while a handler may read it

std::atomic<bool> stopping;
static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a handler may not read it

extern "C" void stopped(int signal) {
  // Another signal, caught by another thread, must not end the program before the note is written.
  if (stopping.exchange(true)) return;
  // After the ^C, or a progress bar. Only calls that a handler may make.
  say_in_handler("\nStopped");
  if (!noted_experiment().empty()) {
    say_in_handler(" in the experiment \"");
    say_in_handler(noted_experiment());
    say_in_handler("\"");
  }
  say_in_handler(".\nNo results were written.\n");
  say_in_handler(advice);
  ::signal(signal, SIG_DFL);
  ::raise(signal);  // once this handler returns, the system ends the program
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

StopNote::StopNote(const std::string& what_now) {
  advice = what_now;
  struct sigaction action {};
  action.sa_handler = stopped;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGINT, &action, nullptr);
}

StopNote::~StopNote() {
  ::sigaction(SIGINT, &before, nullptr);
}

}  // namespace carlo
