#pragma once

#include "09_bias/photon_scenes.h"
#include "grader/judge/figures.h"
#include "grader/judge/judge.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Helpers for the checks of photons.

namespace lab09_photons {

using PhotonVec = glm::dvec3;
using carlo::grader::Diagnosis, carlo::grader::Rows, carlo::grader::Verdict;

inline const Diagnosis flux_differs{
    "flux-differs",
    "all photons of one light carry the same flux: draw directions with a "
    "density in proportion to the cosine, and no weight is left."};

inline PhotonVec vec(const Rows& rows, std::size_t row, std::size_t first) {
  return {rows.at(row, first), rows.at(row, first + 1), rows.at(row, first + 2)};
}

/// The largest relative difference of the channels; infinite for NaN.
inline double off(PhotonVec flux, PhotonVec expected) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const double difference = std::abs(flux[i] - expected[i]);
    const double relative = expected[i] == 0 ? difference : difference / std::abs(expected[i]);
    most = std::isnan(relative) ? HUGE_VAL : std::max(most, relative);
  }
  return most;
}

/// A flux that a typical mistake would give.
struct FluxSuspect {
  PhotonVec flux;
  Diagnosis diagnosis;
};

/// Checks that all photons, at least one, carry the right flux. Returns true if all have the same
/// flux.
inline bool judge_flux(const std::string& what, const std::vector<PhotonVec>& flux,
                       PhotonVec expected, const std::vector<FluxSuspect>& suspects) {
  constexpr double tolerance = 1e-4;
  const auto all = [&](PhotonVec value) {
    return std::all_of(flux.begin(), flux.end(),
                       [&](PhotonVec f) { return off(f, value) <= tolerance; });
  };
  std::vector<Diagnosis> found;
  for (const FluxSuspect& suspect : suspects) {
    if (all(suspect.flux)) found.push_back(suspect.diagnosis);
  }
  const auto worst = std::max_element(flux.begin(), flux.end(), [&](PhotonVec a, PhotonVec b) {
    return off(a, expected) < off(b, expected);
  });
  const bool one_flux = all(flux.front());
  if (!one_flux) found = {flux_differs};
  carlo::grader::judge(carlo::grader::holds(
      what, all(expected), fmt::format("({:.5g}, {:.5g}, {:.5g})", worst->x, worst->y, worst->z),
      fmt::format("({:.5g}, {:.5g}, {:.5g})", expected.x, expected.y, expected.z), found));
  return one_flux;
}

inline std::vector<PhotonVec> fluxes(const Rows& rows, std::size_t first) {
  std::vector<PhotonVec> all;
  for (std::size_t i = 0; i < rows.count(); ++i)
    all.push_back(vec(rows, i, first));
  return all;
}

/// Counts numbers of [0, 1), with `bins` equal parts each, in joint cells.
template <std::size_t dimensions>
class PhotonCells {
 public:
  using Point = std::array<double, dimensions>;
  explicit PhotonCells(std::size_t bins) : bins_(bins) {
    std::size_t cells = 1;
    for (std::size_t i = 0; i < dimensions; ++i)
      cells *= bins;
    counts_.resize(cells);
  }

  void add(const Point& point) {
    std::size_t cell = 0;
    for (const double x : point) {
      const double place = x * static_cast<double>(bins_);
      const bool inside = place >= 0 && place < static_cast<double>(bins_);
      // Rounding, and NaN.
      const std::size_t bin = inside ? static_cast<std::size_t>(place) : place > 0 ? bins_ - 1 : 0;
      cell = cell * bins_ + bin;
    }
    counts_[cell] += 1;
    points_.push_back(point);
  }

  Verdict verdict(const std::string& what) const {
    const double expected =
        static_cast<double>(points_.size()) / static_cast<double>(counts_.size());
    double statistic = 0;
    for (const double count : counts_)
      statistic += (count - expected) * (count - expected) / expected;
    const double freedom = static_cast<double>(counts_.size()) - 1;
    Verdict verdict = carlo::grader::chi_square_fits(what, statistic, freedom,
                                                     fmt::format(" over {} cells", counts_.size()));
    verdict.effect =
        carlo::grader::effect_on_cells(statistic, freedom, static_cast<double>(points_.size()));
    if (!verdict.passed)
      verdict.figure =
          carlo::grader::counts_figure({}, counts_, std::vector(counts_.size(), expected));
    return verdict;
  }

  double mean(std::size_t axis) const {
    double sum = 0;
    for (const Point& point : points_)
      sum += point[axis];
    return sum / static_cast<double>(points_.size());
  }

  /// True if two of the numbers are correlated.
  bool correlated() const {
    for (std::size_t a = 0; a < dimensions; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        double ab = 0, aa = 0, bb = 0;
        for (const Point& point : points_) {
          const double x = point[a] - 0.5, y = point[b] - 0.5;
          ab += x * y;
          aa += x * x;
          bb += y * y;
        }
        if (std::abs(ab) > 0.3 * std::sqrt(aa * bb)) return true;
      }
    }
    return false;
  }

 private:
  std::size_t bins_;
  std::vector<double> counts_;
  std::vector<Point> points_;
};

inline double turn_of(double y, double x) {
  const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
  return turn < 0 ? turn + 1 : turn;
}

}  // namespace lab09_photons
