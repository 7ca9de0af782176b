#pragma once

#include <cstddef>

namespace carlo::grader {

// Linux's features for parents and children; elsewhere these do nothing, and a killed judge may
// leave the program that it judged running until its limits end it. Safe between fork and exec.

/// Sends this process `signal` when its parent ends. Returns false if the kernel refuses.
bool ends_with_parent(int signal);

/// Makes orphans below this process its children. Returns false if the kernel refuses.
bool adopts_orphans();

/// Prevents this process and those that it starts from gaining rights by running a program. Returns
/// false if the kernel refuses.
bool gains_no_privileges();

/// From now on, processes whose parents have ended become children of this one, whatever their
/// session, so that none can outlive end_orphans(). Throws Error if the system refuses.
void adopt_orphans();

/// Kills and reaps all children of this process until there are none. The caller must not have
/// children that it wants to keep. Returns the largest resident memory in bytes of any of them, or
/// of processes that they reaped. Throws Error if some are still alive after ten seconds.
std::size_t end_orphans();

}  // namespace carlo::grader
