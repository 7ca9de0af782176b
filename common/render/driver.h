#pragma once

#include "image/film.h"
#include "numeric/exact_sum.h"
#include "render/blocks.h"
#include "render/integrator.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace carlo {

struct RenderResult;

struct RenderOptions {
  std::uint32_t spp = 64;              ///< samples a pixel, unless `seconds` is set
  std::optional<double> seconds = {};  ///< stop after this time, with whole blocks in every pixel
  int threads = 0;                     ///< 0: one for each core
  bool progress = true;
  /// The result of an earlier render with the same integrator to go on from; its film's block
  /// stays.
  const RenderResult* earlier = nullptr;
  /// These blocks alone of what `spp` asks for. Not with seconds.
  std::optional<BlockRange> share = {};
  /// Called with what is there, while nothing else runs, when this many seconds have gone by.
  std::function<void(const RenderResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
};

struct RenderResult {
  Film film;
  Counts counts{};
  /// Over all blocks of all tiles (blocks.h), Counts::lamp_ties of the paths from lamps that go
  /// with the block's pass: exact, so that it does not depend on who rendered what.
  ExactSum lamp_ties{};
  double seconds = 0;
  int threads = 1;
  bool interrupted = false;  ///< by Ctrl-C; the film holds what was finished
  /// Of each two pixels, the covariance that paths from lamps make, over all pairs; nothing where
  /// lamp_ties tells it.
  std::optional<double> lamp_covariance = {};
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
