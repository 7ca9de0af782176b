#pragma once

#include <sys/types.h>

#include <functional>

namespace carlo::grader {

/// Runs `body` in a process of its own, below another one that guards it: when the body has ended,
/// or the caller has, however it was killed, the guardian ends every process that came of the body,
/// whatever session or parent it has by then. Returns the guardian's id; it ends as the body did
/// (its exit code is what the body returned), and nothing is left behind it. Throws Error.
pid_t start_guarded(const std::function<int()>& body);

}  // namespace carlo::grader
