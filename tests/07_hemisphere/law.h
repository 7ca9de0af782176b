#pragma once

#include "07_hemisphere/pictures.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

// The distribution of directions.

namespace lab07_tests {

/// Directions in the axes of their law, in cells of equal mass in both coordinates together:
/// chi-square, where too good a fit fails as well. A direction outside the law's support fails,
/// except at its edge, where rounding may move it either way. Without a name (`what`), there is no
/// figure.
inline carlo::grader::Verdict distributed(const std::string& what,
                                          const std::vector<Double3>& directions,
                                          const Share& share, double turn = 2 * pi) {
  constexpr int cells = cells_a_side * cells_a_side;
  const auto n = static_cast<double>(directions.size());
  std::vector<double> counts(cells);
  double outside = 0;
  for (Double3 w : directions) {
    if (std::abs(w.z) < 1e-6) w.z = 1e-9;
    const double a = share(w) * cells_a_side, b = azimuth_share(w, turn) * cells_a_side;
    if (!(w.z > 0 && a >= 0 && a <= cells_a_side && b >= 0 && b <= cells_a_side)) {
      outside += 1;
      continue;
    }
    const int i = std::min(static_cast<int>(a), cells_a_side - 1);
    const int j = std::min(static_cast<int>(b), cells_a_side - 1);
    counts[static_cast<std::size_t>(i * cells_a_side + j)] += 1;
  }
  if (outside > 0) {
    carlo::grader::Verdict verdict = carlo::grader::holds(
        what, false, fmt::format("{} of {} outside its support", outside, n), "none");
    if (!what.empty()) verdict.figure = angle_figure(directions, share, pi);
    return verdict;
  }
  double statistic = 0;
  for (const double count : counts)
    statistic += (count - n / cells) * (count - n / cells) / (n / cells);
  carlo::grader::Verdict verdict = carlo::grader::chi_square_fits(
      what, statistic, cells - 1,
      fmt::format(" over {} cells, from {} directions", cells, directions.size()));
  verdict.effect = carlo::grader::effect_on_cells(statistic, cells - 1, n);
  if (!verdict.passed && !what.empty()) {
    verdict.figure = directions_figure(directions, share, counts);
  }
  return verdict;
}

/// True if the directions lie on a curve: at (nearly) every angle there are only a few azimuths,
/// wherever phi starts.
inline bool number_reused(const std::vector<Double3>& directions, const Share& share) {
  std::array<std::array<bool, cells_a_side>, cells_a_side> seen{};
  for (const Double3 w : directions) {
    const double a = share(w) * cells_a_side, b = azimuth_share(w) * cells_a_side;
    if (!(w.z > 1e-6 && a >= 0 && a < cells_a_side && b >= 0 && b < cells_a_side)) continue;
    seen[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = true;
  }
  int angles = 0;
  for (const auto& azimuths : seen) {
    const auto count = std::count(azimuths.begin(), azimuths.end(), true);
    if (count > 4) return false;
    angles += count > 0 ? 1 : 0;
  }
  return angles > cells_a_side / 2;
}

/// Columns first to first + 2 as directions.
inline std::vector<Double3> directions_in(const carlo::grader::Rows& rows, std::size_t first = 0) {
  std::vector<Double3> directions;
  directions.reserve(rows.count());
  for (std::size_t i = 0; i < rows.count(); ++i)
    directions.emplace_back(rows.at(i, first), rows.at(i, first + 1), rows.at(i, first + 2));
  return directions;
}

inline std::vector<Double3> local_to(const Axes& axes, const std::vector<Double3>& directions) {
  std::vector<Double3> local;
  local.reserve(directions.size());
  for (const Double3 w : directions)
    local.push_back(axes.local(w));
  return local;
}

/// The largest deviation of a length from 1; NaN if there is one.
inline double worst_length(const std::vector<Double3>& directions) {
  double worst = 0;
  for (const Double3 w : directions) {
    const double off = std::abs(glm::length(w) - 1);
    if (!(off <= worst)) worst = off;
  }
  return worst;
}

inline carlo::grader::Verdict all_unit(const std::vector<Double3>& directions) {
  const double worst = worst_length(directions);
  return carlo::grader::holds("the length of every direction", worst <= 1e-6,
                              fmt::format("off 1 by up to {:.2g}", worst), "1 within 1e-6",
                              {{"not-unit-length",
                                "directions must have length 1: normalise, or let sine "
                                "and cosine belong to the same angle."}});
}

}  // namespace lab07_tests
