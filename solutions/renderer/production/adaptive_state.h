#pragma once

#include "image/film.h"
#include "render/integrator.h"
#include "renderer/production/half_sums.h"
#include "support/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {

/// Side, in pixels, of the squares for which an adaptive render decides (adaptive.h).
constexpr int adaptive_unit_size = 4;

/// The whole state of an adaptive render between any two of its jobs: a render that continues from
/// a copy ends with the same bits.
struct AdaptiveState {
  struct Unit {
    std::array<bool, 2> fell{};  ///< whether each half has made its decision
    /// Squared relative error times samples, as each half saw it when it last checked.
    std::array<double, 2> noise{};
    bool active() const { return !(fell[0] && fell[1]); }
  };

  AdaptiveState(int film_width, int film_height);

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  /// The fraction of the units (at least one unit) that this half has not decided about: an
  /// estimate of the remaining work by this half alone.
  double undecided(std::size_t half) const;

  std::size_t unit_number(int x, int y) const {
    return static_cast<std::size_t>(y / adaptive_unit_size) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(x / adaptive_unit_size);
  }

  /// Returns the image, its standard errors and numbers of samples.
  Film film() const;

  int width, height;
  int columns;  ///< of units
  std::vector<Unit> units;
  std::array<std::vector<HalfPixel>, 2> halves;
  std::array<double, 2>
      floors{};  ///< per half: the luminance below which errors are relative to it
  /// The next round. If it was cut short, some of its jobs are done; the number of samples that a
  /// half has seen shows which.
  int level = 0;
  double expected_paths = 0;  ///< at the end, for the progress bar
};

/// Such a state and its cost so far.
struct EarlierAdaptive {
  AdaptiveState state;
  Counts counts = {};
  double seconds = 0;
};

struct AdaptiveEstimate {
  double mean, variance;
};

/// Returns the estimate of a pixel's channel R, G, B or luminance (3): (A + B) / 2, with weights
/// that do not depend on the samples; after an interruption, the half that exists.
AdaptiveEstimate adaptive_estimate(const HalfPixel& a, const HalfPixel& b, std::size_t channel);

/// Returns the mean over the pixels of the probability that a normal error is within `target`,
/// relative to the pixel's luminance, or to `floor` if that is larger.
double expected_within(const AdaptiveState& state, double target, double floor);

/// The number of samples in a half after each round: n, 3/2 n, 2 n, 3 n, 4 n ... The samples of
/// each round are aligned runs of a power of two, which Sobol' points fill evenly.
class Levels {
 public:
  explicit Levels(std::uint32_t spp) {
    if (spp < 32) {
      throw Error("--target-error needs at least 32 samples a pixel, got --spp {}", spp);
    }
    first_ = std::min(32u, std::bit_floor(spp / 2));
    while (end(count_) <= spp / 2)
      ++count_;
  }
  int count() const { return count_; }
  std::uint32_t end(int level) const {
    const std::uint32_t octave = first_ << (level / 2);
    return level % 2 == 0 ? octave : octave + octave / 2;
  }
  std::uint32_t begin(int level) const { return level == 0 ? 0 : end(level - 1); }

 private:
  std::uint32_t first_ = 0;
  int count_ = 0;
};

// Rounds of an adaptive render that are shared out. Each share continues from the same state with
// its part of the round's jobs (AdaptiveOptions::share); the parts are then merged. The decisions
// after the round are, bit for bit, those of a render that did all jobs itself: each half of a
// pixel gets its samples of a round in one job.

/// Returns what `state` has beyond `base`, from which it continued; other pixels are empty.
AdaptiveState round_part(const AdaptiveState& state, const AdaptiveState& base);

/// Adds a round's part to the state that it continued from. Throws Error if it continued from
/// another.
void add_round_part(AdaptiveState& base, const AdaptiveState& part);

/// True if no pixel needs another sample, or `spp` allows no more.
bool all_rounds_done(const AdaptiveState& state, std::uint32_t spp);

}  // namespace carlo
