#pragma once

#include "08_path_tracer/theory.h"
#include "grader/judge/judge.h"
#include "stats/distributions.h"

#include <cmath>
#include <cstddef>
#include <vector>

// The expected and actual numbers of exercise 8.3's directions in each cell of the hemisphere.

namespace lab08_tests {

constexpr std::size_t draws = 100'000;

constexpr int rings = 8, sectors = 8;

/// The part of the lobe, (n + 1)/(2 pi) cos^n about the mirror direction, in each cell.
inline std::vector<double> lobe_masses(double n, double degrees) {
  const double angle = degrees * pi / 180;
  const Double3 mirror(-std::sin(angle), 0, std::cos(angle));
  std::vector<double> mass(rings * sectors);
  over_turns(800, [&](double u, double cosine, double sine, double weight) {
    // The mirror direction has no y: the part at -y is the same.
    if (sine < 0) return;
    const double r = std::sqrt(1 - u * u), v = std::atan2(sine, cosine) / (2 * pi);
    const auto ring = static_cast<std::size_t>(u * rings) * sectors;
    const auto sector = static_cast<std::size_t>(v * sectors);
    const double part = weight * (n + 1) * cos_power(mirror, {r * cosine, r * sine, u}, n);
    mass[ring + sector] += part;
    mass[ring + sectors - 1 - sector] += part;
  });
  return mass;
}

/// For the density with theory's kd and ks as probabilities; the last is the part in no cell.
inline std::vector<double> cell_masses(const PhongTheory& theory, const std::vector<double>& lobe) {
  std::vector<double> mass;
  mass.reserve(lobe.size() + 1);
  double none = 1;
  for (std::size_t i = 0; i < lobe.size(); ++i) {
    const std::size_t whole = i / sectors;
    const auto ring = static_cast<double>(whole);
    const double diffuse = (2 * ring + 1) / (rings * rings) / sectors;
    mass.push_back(theory.kd * diffuse + theory.ks * lobe[i]);
    none -= mass.back();
  }
  mass.push_back(none);
  return mass;
}

struct Fit {
  double statistic = 0, freedom = -1;
  bool good() const {
    return carlo::chi_square_two_sided(statistic, freedom) >= carlo::grader::comparison_alpha();
  }
};

/// Chi-square of the counts; neighbouring cells are pooled to 100 expected samples.
inline Fit fit_of(const std::vector<double>& counts, const std::vector<double>& mass) {
  Fit fit;
  double found = 0, expected = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    found += counts[i];
    expected += mass[i] * draws;
    if (expected < 100 && i + 1 < counts.size()) continue;
    if (expected > 0) {
      fit.statistic += (found - expected) * (found - expected) / expected;
      fit.freedom += 1;
    }
    found = expected = 0;
  }
  return fit;
}

/// Counts or masses per ring; the last one stays as it is.
inline std::vector<double> by_rings(const std::vector<double>& cells) {
  std::vector<double> sums(rings);
  for (std::size_t i = 0; i + 1 < cells.size(); ++i)
    sums[i / sectors] += cells[i];
  sums.push_back(cells.back());
  return sums;
}

}  // namespace lab08_tests
