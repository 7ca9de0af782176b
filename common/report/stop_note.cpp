#include "report/stop_note.h"

#include "report/crash_note.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace carlo {
namespace {

struct sigaction before {};

void say(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

extern "C" void stopped(int signal) {
  // Behind the ^C, or a progress bar. Only calls that a handler may make.
  say("\nStopped");
  if (!carlo::noted_experiment().empty()) {
    say(" in the experiment \"");
    say(carlo::noted_experiment());
    say("\"");
  }
  say(".\nNo results were written.\n");
  ::raise(signal);  // the handler is gone: the system ends the program
}

}  // namespace

StopNote::StopNote() {
  struct sigaction action {};
  action.sa_handler = stopped;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
  ::sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGINT, &action, nullptr);
}

StopNote::~StopNote() {
  ::sigaction(SIGINT, &before, nullptr);
}

}  // namespace carlo
