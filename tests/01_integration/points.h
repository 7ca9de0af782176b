#pragma once

// The contents of records for exercises in several dimensions.

#include "grader/judge/judge.h"
#include "grader/protocol/next_words.h"
#include "random/rng.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lab01_tests {

inline const carlo::grader::Diagnosis volume_missing{
    "missing-box-volume",
    "the average over the box is not yet the integral: the box's volume is missing."};

/// Coordinates of points, one after the other.
struct Points {
  std::size_t d;
  std::vector<double> coordinates;

  std::size_t count() const { return coordinates.size() / d; }
  std::span<const double> at(std::size_t i) const {
    return std::span(coordinates).subspan(i * d, d);
  }
  /// The number of points outside the box; NaN is outside.
  double outside(std::span<const double> lowest, std::span<const double> highest) const {
    double astray = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      bool inside = true;
      for (std::size_t k = 0; k < d; ++k)
        inside = inside && at(i)[k] >= lowest[k] && at(i)[k] < highest[k];
      astray += inside ? 0 : 1;
    }
    return astray;
  }
  /// The relative position of each coordinate between the box's ends, from 0 to 1.
  std::vector<double> shares(std::span<const double> lowest,
                             std::span<const double> highest) const {
    std::vector<double> all = coordinates;
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = (all[i] - lowest[i % d]) / (highest[i % d] - lowest[i % d]);
    return all;
  }
  /// Whether all coordinates of each point have the same relative position.
  bool on_diagonal(std::span<const double> lowest, std::span<const double> highest) const {
    const std::vector<double> all = shares(lowest, highest);
    bool same = d > 1;
    for (std::size_t i = 0; i < all.size(); ++i)
      same = same && std::abs(all[i] - all[i - i % d]) <= 1e-9;
    return same;
  }
};

/// The generator before the call, and its next words according to the answer.
struct Drawing {
  carlo::Rng before;
  carlo::grader::NextWords next{};
};

inline Drawing drawing(const carlo::grader::Answer& rows, std::size_t first) {
  Drawing drawing{carlo::Rng(rows.seed)};
  for (std::size_t i = 0; i < drawing.next.size(); ++i)
    drawing.next[i] = rows.values[first + i];
  return drawing;
}

}  // namespace lab01_tests
