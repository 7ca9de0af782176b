#pragma once

#include "image/film.h"
#include "render/adaptive.h"
#include "render/integrator.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

struct RenderResult;

struct RenderOptions {
  std::uint32_t spp = 64;         ///< samples a pixel, unless `seconds` is set
  std::optional<double> seconds;  ///< stop after this time, with whole blocks in every pixel
  int threads = 0;                ///< 0: one for each core
  bool progress = true;
  /// Samples each pixel until its relative error is this (adaptive.h); spp and seconds are limits.
  std::optional<double> target_error = {};
  /// The result of an earlier render with the same integrator to go on from; its film's block
  /// stays. With target_error it must be that of one with the same target.
  const RenderResult* earlier = nullptr;
  /// Called with what is there, while nothing else runs, when this many seconds have gone by.
  std::function<void(const RenderResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
};

struct RenderResult {
  Film film;
  Counts counts{};
  double seconds = 0;
  int threads = 1;
  bool interrupted = false;                      ///< by Ctrl-C; the film holds what was finished
  std::optional<AdaptiveSummary> adaptive = {};  ///< of a render with target_error
  /// Of such a render: what to go on from.
  std::shared_ptr<const AdaptiveState> adaptive_state = {};
};

/// Pixels a side of the squares that are rendered at once; all of a square's pixels have as many
/// blocks.
constexpr int driver_tile_size = 16;

/// The size of the blocks (film.h) for a planned number of samples: the largest power of two that
/// divides spp, leaves at least eight blocks if it can, and is at most 64.
std::uint32_t block_size(std::uint32_t spp);

/// Renders `width` x `height` pixels with any integrator, in tiles, on `threads` threads. The film
/// has the same bits for any number of threads. Exceptions from the integrator reach the caller.
RenderResult render(const Integrator& integrator, int width, int height,
                    const RenderOptions& options);

}  // namespace carlo
