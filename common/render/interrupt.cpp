#include "render/interrupt.h"

#include <array>
#include <csignal>
#include <cstddef>

namespace carlo {
namespace {

volatile std::sig_atomic_t noted = 0;
extern "C" void carlo_on_interrupt(int signal) {
  noted = signal;
}

constexpr std::array<int, 3> interrupts = {SIGINT, SIGTERM, SIGUSR1};
int guards = 0;
std::array<struct sigaction, interrupts.size()> before{};

}  // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0) return;
  noted = 0;
  struct sigaction action {};
  action.sa_handler = carlo_on_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < interrupts.size(); ++i)
    sigaction(interrupts[i], &action, &before[i]);
}

InterruptGuard::~InterruptGuard() {
  if (--guards != 0) return;
  for (std::size_t i = 0; i < interrupts.size(); ++i)
    sigaction(interrupts[i], &before[i], nullptr);
}

bool interrupt_noted() {
  return noted != 0;
}

int interrupt_signal() {
  return noted;
}

}  // namespace carlo
