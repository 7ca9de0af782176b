#pragma once

#include "image/film.h"
#include "numeric/exact_sum.h"
#include "render/blocks.h"
#include "render/integrator.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace carlo {

struct RenderResult;

/// The covariances of an image's pixels. Exact sums over all blocks of all tiles (blocks.h), so
/// that they do not depend on how the blocks were shared out.
struct PixelCovariance {
  ExactSum splats;                 ///< Counts::splat_covariance of the block's pass
  std::array<ExactSum, 3> shared;  ///< Counts::shared_covariance

  void add(const PixelCovariance& other) {
    splats.add(other.splats);
    for (std::size_t c = 0; c < 3; ++c)
      shared[c].add(other.shared[c]);
  }
  friend bool operator==(const PixelCovariance&, const PixelCovariance&) = default;
};

struct RenderOptions {
  std::uint32_t spp = 64;              ///< samples per pixel, unless `seconds` is set
  std::optional<double> seconds = {};  ///< stop after this time, with whole blocks in every pixel
  int threads = 0;                     ///< 0: one per core
  bool progress = true;
  /// The result of an earlier render with the same integrator, to continue from; its film's block
  /// size is kept.
  const RenderResult* earlier = nullptr;
  /// Renders only these blocks of what `spp` asks for. Not with `seconds`.
  std::optional<BlockRange> share = {};
  /// Called with the current result every `checkpoint_seconds`, while no other thread works.
  std::function<void(const RenderResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
};

struct RenderResult {
  Film film;
  Counts counts{};
  PixelCovariance covariance{};
  double seconds = 0;
  int threads = 1;
  bool interrupted = false;  ///< by Ctrl-C; the film holds the finished blocks
  /// The covariances of the pixels caused by light paths, summed over all pairs; nothing if
  /// they follow from `covariance`.
  std::optional<double> light_path_covariance = {};
};

/// Returns the size of the blocks (film.h) for a planned number of samples: the largest power of
/// two that divides spp, leaves at least eight blocks if possible, and is at most 64.
std::uint32_t block_size(std::uint32_t spp);

/// Renders `width` x `height` pixels with any integrator, in tiles, on several threads. The film
/// has the same bits for any number of threads. Rethrows exceptions of the integrator.
RenderResult render(const Integrator& integrator, int width, int height,
                    const RenderOptions& options);

/// Runs `work` in an arena of this many threads (0: one per core), which TBB's algorithms use.
/// Returns the number of threads. Rethrows exceptions of `work`.
int on_threads(int threads, const std::function<void()>& work);

}  // namespace carlo
