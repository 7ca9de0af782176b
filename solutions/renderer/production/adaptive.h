#pragma once

#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/block_set.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

/// The goal of an adaptive render, and its limits.
struct AdaptiveGoal {
  double target = 0.01;           ///< relative error of a pixel, at 95 % confidence
  std::uint32_t spp = 1u << 16;   ///< limit of samples per pixel
  std::optional<double> seconds;  ///< time limit; every pixel still gets 64 samples
};

/// The report of an adaptive render, besides its film.
struct AdaptiveSummary {
  double target = 0;
  double floor = 0;   ///< luminance; errors of darker pixels are relative to it
  double within = 0;  ///< expected fraction of the pixels whose error is within the target
  double capped = 0;  ///< fraction of the pixels that were cut off by spp, seconds or Ctrl-C
  std::uint64_t least = 0, median = 0, most = 0;  ///< samples per pixel
  double light_samples =
      0;  ///< expected_light_samples() (light_coverage.h) where samples are fewest
  double decided_only = 0;  ///< fraction of the samples used only for decisions, not for the image
};

/// The film holds estimates, standard errors and numbers of samples.
struct AdaptiveResult : RenderResult {
  AdaptiveSummary summary;
  std::shared_ptr<const AdaptiveState> state;  ///< to continue from
};

struct AdaptiveOptions {
  int threads = 0;  ///< 0: one per core
  bool progress = true;
  /// The result of an earlier render with the same integrator and target, to continue from: the
  /// bits are those of a render that was never interrupted.
  const EarlierAdaptive* earlier = nullptr;
  /// Called with the current result every `checkpoint_seconds`, while no other thread works.
  std::function<void(const AdaptiveResult&)> checkpoint = {};
  double checkpoint_seconds = 60;
  /// Does only this share of the next round's jobs, and makes no decisions (adaptive_state.h).
  /// Every share traces all light paths; only the first counts them.
  std::optional<Shard> share = {};
  /// Does only the next round, including its decisions.
  bool one_round = false;
};

/// Renders so that each pixel's luminance is within `goal.target` of the truth, relatively, with 95
/// % confidence. The errors of pixels darker than 1 % of the image's mean are relative to that 1 %.
///
/// Samples that also decide when to stop are biased: a pixel whose bright paths have not been found
/// yet looks dark and finished. So each pixel has two halves with independent streams, each of
/// which decides for the other: half A's estimate is its mean over the first n samples, where n is
/// a function of half B's samples alone, and vice versa. Both estimates and their standard errors
/// are exactly unbiased, and so is the image, (A + B) / 2. Where the halves disagree, both are
/// sampled until both decisions have been taken, and samples that the estimates leave out are lost
/// (`decided_only`).
///
/// Decisions are taken for blocks of 4 x 4 pixels, after 32, 48, 64, 96, 128 ... samples per half
/// (Sobol' points need aligned powers of two): 16 pixels show their variance more reliably than
/// one, and a rare bright path in one keeps all of them sampled. A block is finished when the
/// errors of its pixels are within the target on average (root mean square), would be so with the
/// noise of the surrounding blocks as well, and the worst estimate is at most 3 times the target.
/// The neighbours find most of the bright paths that a block has missed. No block is finished
/// before each light has been sampled ten times around it (light_coverage.h), unless that takes
/// more than 1024 samples per half; the summary then shows it.
///
/// The film's bits do not depend on the number of threads. Throws Error if the target is not a
/// finite number above 0, if spp is below 32, or if the earlier render does not fit the film or its
/// samples do not fit the rounds.
AdaptiveResult render_adaptively(const Integrator& integrator, int width, int height,
                                 const AdaptiveGoal& goal, const AdaptiveOptions& options = {});

/// The planned number of samples per pixel that suits the stratified sampler in an adaptive render.
constexpr std::uint32_t adaptive_strata = 32;

}  // namespace carlo
