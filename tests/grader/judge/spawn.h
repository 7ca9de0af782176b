#pragma once

#include "course/cli/descriptor.h"
#include "grader/judge/process.h"

#include <sys/types.h>

#include <string>

namespace carlo::grader {

/// A child process and the ends of its pipes that we read from (they do not block).
struct Spawned {
  pid_t pid = -1;
  Descriptor result;         ///< its descriptor 3
  Descriptor output;         ///< its descriptors 1 and 2
  std::string problem = {};  ///< why the program was not begun; empty when it was
};

/// Starts a process as run_limited() says. Throws Error when the system refuses. A child that
/// cannot confine itself, or whose program cannot be loaded, never begins it and says so.
Spawned spawn(const Command& command, const Limits& limits);

}  // namespace carlo::grader
