#pragma once

#include <functional>

namespace carlo {

/// Does `work` with so many threads (0: one for each core), among which TBB's algorithms share it.
/// Returns how many there were. Exceptions of the work reach the caller.
int on_threads(int threads, const std::function<void()>& work);

}  // namespace carlo
