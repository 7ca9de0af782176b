#pragma once

namespace carlo {

/// While one is there, Ctrl-C does not end the program but is noted; a second Ctrl-C ends it. So
/// are SIGTERM and SIGUSR1, by which batch systems say that time is up. They may be nested:
/// render() has one, and a program that renders several times may have one around them. From one
/// thread.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Whether one of them was noted since the outermost guard came. From any thread.
bool interrupt_noted();

/// The number of the signal that was noted last; 0 if none was.
int interrupt_signal();

}  // namespace carlo
