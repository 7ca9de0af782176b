#pragma once

#include "grader/judge/syscall_filter.h"

#include <sys/types.h>

#include <optional>
#include <string>

namespace carlo::grader {

/// What a child takes upon itself between fork and exec, besides limits, a session of its own and
/// no new privileges. Descriptors stay the caller's.
struct Confinement {
  std::string folder = {};                   ///< its working folder; empty: the caller's
  std::optional<uid_t> user = {};            ///< its user and only group, where we are root
  std::optional<SyscallFilter> filter = {};  ///< the system calls that it may not make
  int landlock_rules = -1;                   ///< what of the disk it may open
  int inherited = -1;                        ///< becomes its descriptor 4
  int status = -1;                           ///< becomes its descriptor 5
  bool untrusted = false;                    ///< where memory runs out, it is ended first
  std::optional<std::string> measured = {};  ///< the folder that may not grow without end
};

}  // namespace carlo::grader
