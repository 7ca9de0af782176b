#include "render/lamp_pass.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

namespace carlo {

LampPass::LampPass(const Integrator& integrator, std::size_t pixels, std::uint32_t stream,
                   std::uint32_t first_sample, std::uint32_t samples) {
  const std::uint64_t per_sample = integrator.lamp_paths() * pixels;
  if (per_sample == 0) return;
  const std::uint64_t first = first_sample * per_sample, count = samples * per_sample;
  paths_ = static_cast<double>(count);
  splats_.emplace(pixels, integrator.splat_unit(count));
  constexpr std::uint64_t at_once = 1 << 14;
  std::mutex mutex;
  tbb::parallel_for(
      std::uint64_t{0}, (count + at_once - 1) / at_once,
      [&](std::uint64_t part) {
        if (render_interrupted()) return;
        const std::uint64_t begin = part * at_once;
        Counts counts;
        integrator.trace_lamps({first + begin, std::min(at_once, count - begin), stream}, *splats_,
                               counts);
        const std::lock_guard lock(mutex);
        counts_ += counts;
      },
      tbb::simple_partitioner{});
}

}  // namespace carlo
