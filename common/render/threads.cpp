#include "render/threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace carlo {

static constexpr std::size_t max_threads = 1024;

int on_threads(int threads, const std::function<void()>& work) {
  const int count = threads > 0 ? threads : static_cast<int>(tbb::info::default_concurrency());
  // Lets arenas have more workers than there are cores. A single limit for the whole program,
  // because TBB does not handle lowering and raising it again well.
  static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, max_threads);
  tbb::task_arena arena(count);
  arena.execute(work);
  return count;
}

}  // namespace carlo
