#pragma once

#include "grader/judge/syscall_filter.h"

#include <sys/types.h>

#include <optional>
#include <string>

namespace carlo::grader {

/// A child's confinement of itself between fork and exec, besides limits, its own session and no
/// new privileges. Descriptors stay the caller's.
struct Confinement {
  std::string folder = {};                   ///< its working folder; empty: the caller's
  std::optional<uid_t> user = {};            ///< its user and only group, if we are root
  std::optional<SyscallFilter> filter = {};  ///< the system calls that it may not make
  int landlock_rules = -1;                   ///< rules for opening files
  int inherited = -1;                        ///< becomes its descriptor 4
  int status = -1;                           ///< becomes its descriptor 5
  bool untrusted = false;                    ///< if memory runs out, it is killed first
  std::optional<std::string> measured = {};  ///< the folder whose size is limited
};

}  // namespace carlo::grader
