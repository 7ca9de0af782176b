#pragma once

#include <cstddef>

namespace carlo::grader {

/// From now on, processes whose parents have ended become children of this one, whatever session
/// they moved to, so that none can outlive end_orphans(). Throws Error when the system refuses.
void adopt_orphans();

/// Kills and reaps all children of this process until there are none. The caller has no child that
/// it wants to keep. Returns the largest resident memory that one of them, or a process that it has
/// reaped itself, ever had, in bytes. Throws Error when some still live after ten seconds.
std::size_t end_orphans();

}  // namespace carlo::grader
