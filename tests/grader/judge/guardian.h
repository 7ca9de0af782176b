#pragma once

#include <sys/types.h>

#include <functional>

namespace carlo::grader {

/// Runs `body` in its own process, below a guardian process: when the body has ended, or the caller
/// has, however it was killed, the guardian ends every descendant of the body, whatever its session
/// or parent is by then. Returns the guardian's id; it ends as the body did (its exit code is what
/// the body returned), and leaves nothing behind. Throws Error.
pid_t start_guarded(const std::function<int()>& body);

}  // namespace carlo::grader
