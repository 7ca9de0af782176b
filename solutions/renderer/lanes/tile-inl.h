// Traces all paths of a tile. Included once for each instruction set.

#if defined(CARLO_TILE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_TILE_INL
#undef CARLO_TILE_INL
#else
#define CARLO_TILE_INL
#endif

#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/starts-inl.h"
#include "renderer/lanes/sums-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// render_lanes() for scenes that need no more than `Needs`.
template <class Needs>
HWY_ATTR void run(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts) {
  Starts starts(job);
  Sums sums(job, means);
  Visits visits;
  // Few enough that a learner finds their visits in the cache.
  const std::uint32_t most_at_once = job.learner != nullptr ? 1 << 11 : Sums::most;
  const Walk<Needs> walk(job, counts, job.learner != nullptr ? &visits : nullptr);
  // One register of paths, or a batch if there may be sdfs; a constant for the compiler.
  constexpr std::size_t most = Needs::full ? batch : 1;
  const std::size_t registers = Needs::full && !job.scene.sdfs.empty() ? most : 1;
  auto paths = zeros<std::array<Paths, most>>();
  auto before = zeros<std::array<M, most>>();
  for (Paths& some : paths)
    some.alive = hn::FirstN(d_, 0);
  std::uint32_t waited_for = starts.allow(most_at_once);
  for (std::uint64_t round = 0;; ++round) {
    bool alive = false;
    for (std::size_t w = 0; w < registers; ++w) {
      starts.refill<Needs>(paths[w], counts);
      before[w] = paths[w].alive;
      alive = alive || !hn::AllFalse(d_, before[w]);
    }
    if (!alive) {
      if (job.learner != nullptr) job.learner->add(visits, sums.stored(waited_for)), visits.clear();
      sums.add(waited_for);
      waited_for = starts.allow(most_at_once);
      if (waited_for == 0) break;
      continue;
    }
    if (round % 4096 == 4095 && carlo::render_interrupted()) return;
    if constexpr (Needs::full)
      walk.extend_batch({paths.data(), registers});
    else
      walk.extend(paths[0]);
    for (std::size_t w = 0; w < registers; ++w) {
      const M ended = hn::AndNot(paths[w].alive, before[w]);
      if (!hn::AllFalse(d_, ended)) sums.radiances().keep(paths[w], ended, counts);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_TILE_INL
