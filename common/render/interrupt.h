#pragma once

namespace carlo {

/// While one is there, Ctrl-C does not end the program but is noted; a second Ctrl-C ends it. They
/// may be nested: render() has one, and a program that renders several times may have one around
/// them. From one thread.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Whether Ctrl-C was noted since the outermost guard came. From any thread.
bool interrupt_noted();

}  // namespace carlo
