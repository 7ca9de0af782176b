#pragma once

#include <cstddef>

namespace carlo::grader {

/// From now on, processes whose parents have ended become children of this one, whatever their
/// session, so that none can outlive end_orphans(). Throws Error if the system refuses.
void adopt_orphans();

/// Kills and reaps all children of this process until there are none. The caller must not have
/// children that it wants to keep. Returns the largest resident memory in bytes of any of them, or
/// of processes that they reaped. Throws Error if some are still alive after ten seconds.
std::size_t end_orphans();

}  // namespace carlo::grader
