#include "render/interrupt.h"

#include <csignal>

namespace carlo {
namespace {

volatile std::sig_atomic_t noted = 0;
extern "C" void carlo_on_interrupt(int) {
  noted = 1;
}

int guards = 0;
struct sigaction before {};

}  // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0) return;
  noted = 0;
  struct sigaction action {};
  action.sa_handler = carlo_on_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &before);
}

InterruptGuard::~InterruptGuard() {
  if (--guards == 0) sigaction(SIGINT, &before, nullptr);
}

bool interrupt_noted() {
  return noted != 0;
}

}  // namespace carlo
