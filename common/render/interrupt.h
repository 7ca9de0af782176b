#pragma once

namespace carlo {

/// While a guard exists, Ctrl-C does not end the program but is noted; a second Ctrl-C ends it.
/// SIGTERM and SIGUSR1, by which batch systems announce that time is up, are noted as well. Guards
/// may be nested: render() has one, and a program that renders several times may have one around
/// them. For use from one thread.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// True if one of these signals was noted since the outermost guard was made. From any thread.
bool interrupt_noted();

/// The number of the signal noted last; 0 if there was none.
int interrupt_signal();

}  // namespace carlo
