#pragma once

#include "course/cli/descriptor.h"
#include "grader/judge/process.h"

#include <sys/types.h>

#include <string>

namespace carlo::grader {

/// A child process and our ends of its pipes (non-blocking).
struct Spawned {
  pid_t pid = -1;
  Descriptor result;         ///< its descriptor 3
  Descriptor output;         ///< its descriptors 1 and 2
  std::string problem = {};  ///< why the program was not started; empty if it was
};

/// Starts a process as described at run_limited(). Throws Error if the system refuses. A child that
/// cannot confine itself, or whose program cannot be loaded, reports that instead of starting it.
Spawned spawn(const Command& command, const Limits& limits);

}  // namespace carlo::grader
