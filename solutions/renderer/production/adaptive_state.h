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

/// Pixels a side of the squares for which an adaptive render decides (adaptive.h).
constexpr int adaptive_unit_size = 4;

/// All that an adaptive render knows, between any two of its jobs: what goes on from a copy ends
/// with the same bits.
struct AdaptiveState {
  struct Unit {
    std::array<bool, 2> fell{};  ///< whether the decision that a half takes has fallen
    /// Squared relative error times samples, as a half saw it when it last looked.
    std::array<double, 2> noise{};
    bool active() const { return !(fell[0] && fell[1]); }
  };

  AdaptiveState(int film_width, int film_height);

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  /// The share of the units, of one at least, whose decision by this half has not fallen: how much
  /// there is left to sample, as this half alone knows it.
  double undecided(std::size_t half) const;

  std::size_t unit_number(int x, int y) const {
    return static_cast<std::size_t>(y / adaptive_unit_size) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(x / adaptive_unit_size);
  }

  /// The image, its standard errors and numbers of samples.
  Film film() const;

  int width, height;
  int columns;  ///< of units
  std::vector<Unit> units;
  std::array<std::vector<HalfPixel>, 2> halves;
  std::array<double, 2>
      floors{};  ///< the luminance of each half below which errors are relative to it
  /// The round that comes next. Where it was cut short some of its jobs are done; the number of
  /// samples that a half has seen tells which.
  int level = 0;
  double expected_paths = 0;  ///< in the end, for the progress bar
};

/// Such a state, and what it cost.
struct EarlierAdaptive {
  AdaptiveState state;
  Counts counts = {};
  double seconds = 0;
};

struct AdaptiveEstimate {
  double mean, variance;
};

/// Of a pixel's channel R, G, B or luminance (3): (A + B) / 2, with weights that no sample has a
/// say in; after an interruption the half that is.
AdaptiveEstimate adaptive_estimate(const HalfPixel& a, const HalfPixel& b, std::size_t channel);

/// The mean over the pixels of the probability that a normal error is within `target`, relative to
/// the pixel's luminance, or to `floor` where it is darker.
double expected_within(const AdaptiveState& state, double target, double floor);

/// The samples of a half after a number of rounds: n, 3/2 n, 2 n, 3 n, 4 n ... The samples of each
/// round are aligned runs of a power of two, which Sobol' points fill evenly.
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

// A round of an adaptive render that several share. Each goes on from the same state with a share
// of the round's jobs (AdaptiveOptions::share); what they add is put together, and the decisions
// behind the round are those of one that did all of it, bit for bit: a pixel's half gets its
// samples of a round in one job.

/// What a state has that `base`, from which it went on, has not; empty pixels elsewhere.
AdaptiveState round_part(const AdaptiveState& state, const AdaptiveState& base);

/// Puts a round's part into the state that it went on from. Throws Error if it went on from
/// another.
void add_round_part(AdaptiveState& base, const AdaptiveState& part);

/// Whether no pixel wants another sample, or none may have one: `spp` is the limit.
bool all_rounds_done(const AdaptiveState& state, std::uint32_t spp);

}  // namespace carlo
