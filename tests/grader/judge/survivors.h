#pragma once

namespace carlo::grader {

/// From now on, processes whose parents have ended become children of this one, whatever session
/// they moved to, so that none can outlive end_orphans(). Throws Error when the system refuses.
void adopt_orphans();

/// Kills and reaps all children of this process until there are none. The caller has no child that
/// it wants to keep. Throws Error when some still live after two seconds.
void end_orphans();

}  // namespace carlo::grader
