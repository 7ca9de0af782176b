#include "report/stop_note.h"

#include "report/crash_note.h"
#include "report/say_in_handler.h"

#include <csignal>
#include <string>

namespace carlo {
namespace {

struct sigaction before {};
std::string advice;  // of the note that lives: it does not change while a handler may read it

extern "C" void stopped(int signal) {
  // Behind the ^C, or a progress bar. Only calls that a handler may make.
  say_in_handler("\nStopped");
  if (!noted_experiment().empty()) {
    say_in_handler(" in the experiment \"");
    say_in_handler(noted_experiment());
    say_in_handler("\"");
  }
  say_in_handler(".\nNo results were written.\n");
  say_in_handler(advice);
  ::raise(signal);  // when this one returns: the handler is gone, the system ends the program
}

}  // namespace

StopNote::StopNote(const std::string& what_now) {
  advice = what_now;
  struct sigaction action {};
  action.sa_handler = stopped;
  // Not SA_NODEFER: a second Ctrl-C waits until the note is written.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGINT, &action, nullptr);
}

StopNote::~StopNote() {
  ::sigaction(SIGINT, &before, nullptr);
}

}  // namespace carlo
