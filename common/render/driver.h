#pragma once

#include "image/film.h"
#include "numeric/exact_sum.h"
#include "render/adaptive.h"
#include "render/blocks.h"
#include "render/integrator.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

struct RenderResult;

struct RenderOptions {
  std::uint32_t spp = 64;              ///< samples a pixel, unless `seconds` is set
  std::optional<double> seconds = {};  ///< stop after this time, with whole blocks in every pixel
  int threads = 0;                     ///< 0: one for each core
  bool progress = true;
  /// Samples each pixel until its relative error is this (adaptive.h); spp and seconds are limits.
  std::optional<double> target_error = {};
  /// The result of an earlier render with the same integrator to go on from; its film's block
  /// stays. With target_error it must be that of one with the same target.
  const RenderResult* earlier = nullptr;
  /// These blocks alone of what `spp` asks for. Not with seconds or target_error.
  std::optional<BlockRange> share = {};
  /// With target_error: of the next round this share of the jobs alone, and no decision.
  std::optional<Shard> round_share = {};
  /// With target_error: the next round alone, and what it decides.
  bool one_round = false;
  /// Called with what is there, while nothing else runs, when this many seconds have gone by.
  std::function<void(const RenderResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
};

struct RenderResult {
  Film film;
  Counts counts{};
  /// Over all blocks of all tiles (blocks.h), Counts::lamp_ties of the paths from lamps that go
  /// with the block's pass: exact, so that it does not depend on who rendered what. None with
  /// target_error.
  ExactSum lamp_ties{};
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

/// The blocks of which a film is made in the end.
BlockGrid block_grid(const Film& film, std::uint32_t spp);

/// Which of a share's blocks a film holds, of a render of just these. A tile's blocks are rendered
/// in order; tiles differ by one after an interruption. Throws Error if they differ by more.
BlockSet blocks_done(const Film& film, const BlockRange& share);

/// Renders `width` x `height` pixels with any integrator, in tiles, on `threads` threads. The film
/// has the same bits for any number of threads. Exceptions from the integrator reach the caller.
RenderResult render(const Integrator& integrator, int width, int height,
                    const RenderOptions& options);

}  // namespace carlo
