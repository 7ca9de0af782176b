#pragma once

#include <functional>

namespace carlo {

/// Runs `work` in an arena of this many threads (0: one per core), which TBB's algorithms use.
/// Returns the number of threads. Rethrows exceptions of `work`.
int on_threads(int threads, const std::function<void()>& work);

}  // namespace carlo
