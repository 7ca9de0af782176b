#include "course/report/stop_note.h"

#include "course/report/crash_note.h"
#include "course/report/signal_handler.h"

#include <atomic>
#include <csignal>
#include <string>

namespace carlo {
namespace {

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
