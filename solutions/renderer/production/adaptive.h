#pragma once

#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/block_set.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

/// When an adaptive render is done.
struct AdaptiveGoal {
  double target = 0.01;           ///< relative error of a pixel, at 95 % confidence
  std::uint32_t spp = 1u << 16;   ///< no pixel gets more samples
  std::optional<double> seconds;  ///< stop after this time, with 64 samples in every pixel
};

/// What an adaptive render tells of itself besides its film.
struct AdaptiveSummary {
  double target = 0;
  double floor = 0;   ///< luminance: errors of darker pixels are relative to this
  double within = 0;  ///< expected fraction of the pixels whose error is within the target
  double capped = 0;  ///< fraction of the pixels that were ended by spp, seconds or Ctrl-C
  std::uint64_t least = 0, median = 0, most = 0;  ///< samples of a pixel
  double asks = 0;                                ///< light_asks.h, where the samples are fewest
  double decided_only = 0;  ///< fraction of the samples that served decisions, not the image
};

/// The film holds estimates, standard errors and numbers of samples.
struct AdaptiveResult : RenderResult {
  AdaptiveSummary summary;
  std::shared_ptr<const AdaptiveState> state;  ///< to go on from
};

struct AdaptiveOptions {
  int threads = 0;  ///< 0: one for each core
  bool progress = true;
  /// What an earlier one with the same integrator and target came to, to go on from: the bits are
  /// those of one that was never interrupted.
  const EarlierAdaptive* earlier = nullptr;
  /// Called with what is there when this many seconds have gone by, while nothing else runs.
  std::function<void(const AdaptiveResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
  /// Of the next round this share of the jobs alone, and no decision (adaptive_state.h). Paths
  /// from lamps are traced whole by each share, and counted by the first.
  std::optional<Shard> share = {};
  /// The next round alone, and what it decides.
  bool one_round = false;
};

/// Renders so that each pixel's luminance is within `goal.target` of the truth, relatively, with 95
/// % confidence. For pixels darker than 1 % of the image's mean, that 1 % takes their place in the
/// quotient.
///
/// Samples that also decide when to stop are biased: a pixel whose bright paths have not come yet
/// looks dark and finished. So each pixel has two halves of independent streams, and the one
/// decides for the other: half A's estimate is its mean over the first n samples, where n is a
/// function of half B's samples alone, and the other way round. Both estimates are exactly
/// unbiased, their standard errors too, and so is the image, (A + B) / 2. Where the halves disagree
/// both are sampled until both decisions have fallen, and what the estimates leave out is lost
/// (`decided_only`).
///
/// Decisions are taken for blocks of 4 x 4 pixels, after 32, 48, 64, 96, 128 ... samples a half
/// (aligned powers of two are what Sobol' points want): 16 pixels tell their variance more surely
/// than one, and a rare bright path in one keeps all going. A block is done when its pixels' errors
/// are within the target on average (root mean square), would be with the noise of the blocks
/// around it, too, and the worst estimate is at most 3 times the target. The neighbours are what
/// finds most of the bright paths that a block has not met; and none is done before each light has
/// been asked ten times there (light_asks.h), unless that takes more than 1024 samples a half: then
/// the summary tells.
///
/// The film's bits do not depend on the number of threads. Throws Error
/// if the target is not a finite number above 0, spp is below 32, or the earlier render does not
/// fit the film, or its samples the rounds.
AdaptiveResult render_adaptively(const Integrator& integrator, int width, int height,
                                 const AdaptiveGoal& goal, const AdaptiveOptions& options = {});

/// The planned number of samples that suits the stratified sampler in an adaptive render.
constexpr std::uint32_t adaptive_strata = 32;

}  // namespace carlo
