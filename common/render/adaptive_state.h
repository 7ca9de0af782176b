#pragma once

#include "image/film.h"
#include "render/half_sums.h"

#include <array>
#include <cstddef>
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

struct AdaptiveEstimate {
  double mean, variance;
};

/// Of a pixel's channel R, G, B or luminance (3): (A + B) / 2, with weights that no sample has a
/// say in; after an interruption the half that is.
AdaptiveEstimate adaptive_estimate(const HalfPixel& a, const HalfPixel& b, std::size_t channel);

/// The mean over the pixels of the probability that a normal error is within `target`, relative to
/// the pixel's luminance, or to `floor` where it is darker.
double expected_within(const AdaptiveState& state, double target, double floor);

}  // namespace carlo
