#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

// The inputs of lab 5's probes, which the checks use too.

namespace lab05_tests {

/// The distributions of Labs 5.1 to 5.3 and their two parameters: rate; ends f0, f1; radius; n.
enum class Family { exponential = 0, linear = 1, tent = 2, power = 3 };

const double last_below_one = std::nextafter(1.0, 0.0);

/// Numbers u in increasing order: both ends of [0, 1), tiny ones, and 99 in between.
inline std::vector<double> hard_numbers() {
  std::vector<double> u = {0, 1e-300, 1e-100, 1e-30, 1e-18, 0x1p-53, 1e-12, 1e-6};
  for (int i = 1; i < 100; ++i)
    u.push_back(i / 100.0);
  for (const double x : {1 - 1e-6, 1 - 1e-12, last_below_one})
    u.push_back(x);
  return u;
}

/// Tables of weights. If edges are tested the sums are powers of two, so that the CDF is exact.
enum class Weights {
  eighths = 0,  ///< 1 2 3 2
  gaps = 1,     ///< zeros at the beginning, in the middle and at the end
  one = 2,      ///< a single bin
  tiny = 3,     ///< so small that 1 / sum is infinite
  rugged = 4,   ///< 300 weights over three orders of magnitude, every seventh 0
  comb = 5,     ///< 2^17 bins, every second 0
  sixths = 6,   ///< six equal weights, whose shares add up to less than 1 in double, and two zeros
  speck = 7,    ///< a tiny weight first: (u - C_(i-1))/(C_i - C_(i-1)) rounds to 1 just below C_i
  rare = 8,     ///< 1e-9 and 1e-6 of the total, between large ones
  count = 9
};

inline std::vector<double> weights_of(Weights kind) {
  switch (kind) {
    case Weights::eighths:
      return {1, 2, 3, 2};
    case Weights::gaps:
      return {0, 0, 1, 0, 2, 0, 0, 1, 0};
    case Weights::one:
      return {0.3};
    case Weights::tiny:
      return {1e-310, 0, 3e-310};
    case Weights::sixths:
      return {1, 1, 1, 1, 1, 1, 0, 0};
    case Weights::speck:
      return {0x1.59d47572ecfc6p-54, 0x1.2afc230d15f83p+0, 0x1.76c2932eb8218p-3};
    case Weights::rare:
      return {3, 1e-8, 2, 1e-5, 5};
    case Weights::comb: {
      std::vector<double> weights(std::size_t{1} << 17);
      for (std::size_t i = 1; i < weights.size(); i += 2)
        weights[i] = 1;
      return weights;
    }
    case Weights::rugged:
    case Weights::count:
      break;
  }
  std::vector<double> weights(300);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double wave = std::sin(0.37 * static_cast<double>(i));
    weights[i] = i % 7 == 3 ? 0 : std::pow(10.0, 1.5 * wave);
  }
  return weights;
}

/// The running sums divided by the last.
inline std::vector<double> exact_cdf(const std::vector<double>& weights) {
  long double sum = 0;
  std::vector<long double> sums;
  for (const double weight : weights)
    sums.push_back(sum += weight);
  std::vector<double> cdf;
  cdf.reserve(sums.size());
  for (const long double s : sums)
    cdf.push_back(static_cast<double>(s / sum));
  return cdf;
}

/// Numbers within shares that are rare, but wider than rounding: no number with 24 bits falls into
/// them.
inline std::vector<double> within_rare(const std::vector<double>& cdf) {
  std::vector<double> u;
  for (std::size_t i = 0; i < cdf.size(); ++i) {
    const double before = i == 0 ? 0 : cdf[i - 1], width = cdf[i] - before;
    if (!(width > 1e-10 && width < 2e-6)) continue;
    for (const double fraction : {0.05, 0.25, 0.5, 0.75, 0.95})
      u.push_back(before + fraction * width);
  }
  return u;
}

/// Test numbers: hard_numbers(), every edge of the CDF and the last double before it, and some
/// within rare shares.
inline std::vector<double> numbers_for(const std::vector<double>& weights) {
  std::vector<double> u = hard_numbers();
  for (const double edge : exact_cdf(weights)) {
    if (edge > 0 && edge < 1) u.insert(u.end(), {std::nextafter(edge, 0.0), edge});
  }
  const std::vector<double> rare = within_rare(exact_cdf(weights));
  u.insert(u.end(), rare.begin(), rare.end());
  std::sort(u.begin(), u.end());
  u.erase(std::unique(u.begin(), u.end()), u.end());
  return u;
}

/// The 2D tables: a small one with an empty row, an empty column and an exact CDF, and a smooth
/// one.
struct Grid {
  std::size_t width = 0, height = 0;
  std::vector<double> weights;  ///< row by row

  double at(std::size_t i, std::size_t j) const { return weights[j * width + i]; }
};

inline Grid small_grid() {
  // Rows sum to 4, 0, 8, 4.
  return {3, 4, {1, 0, 3, 0, 0, 0, 6, 0, 2, 2, 0, 2}};
}

inline Grid smooth_grid() {
  Grid grid{16, 12, {}};
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      grid.weights.push_back(1.2 + std::sin(0.5 * x) * std::cos(0.4 * y) + 0.05 * x);
    }
  }
  return grid;
}

/// A sky with a sun: rows without it have less than 1e-8 of the total, texels beside it 1e-9 of
/// their row.
inline Grid sun_grid() {
  return {4, 3, {1, 2, 1, 3, 1, 1, 1e9, 1, 2, 1, 1, 2}};
}

enum class GridKind { small = 0, smooth = 1, sun = 2, count = 3 };

inline Grid grid_of(GridKind kind) {
  return kind == GridKind::smooth ? smooth_grid()
         : kind == GridKind::sun  ? sun_grid()
                                  : small_grid();
}

/// Numbers for rows and for columns: hard_numbers() and some within rare shares.
inline std::vector<double> numbers_for(const Grid& grid) {
  std::vector<double> u = hard_numbers(), sums(grid.height);
  const auto add = [&](const std::vector<double>& weights) {
    const std::vector<double> rare = within_rare(exact_cdf(weights));
    u.insert(u.end(), rare.begin(), rare.end());
  };
  for (std::size_t j = 0; j < grid.height; ++j) {
    std::vector<double> row;
    for (std::size_t i = 0; i < grid.width; ++i)
      row.push_back(grid.at(i, j));
    sums[j] = std::accumulate(row.begin(), row.end(), 0.0);
    if (sums[j] > 0) add(row);
  }
  add(sums);
  return u;
}

/// The functions that Lab 5.7 draws from. Each stays below its bound, also on [0, b - a).
enum class Target { square = 0, sine = 1, step = 2, count = 3 };

struct TargetCase {
  double a, b, bound;
  double integral;   ///< of f over [a, b)
  double below_one;  ///< the integral of min(f, 1)
};

inline TargetCase target_case(Target target) {
  switch (target) {
    case Target::square:
      return {-1, 2, 10, 3, 5.0 / 3};
    case Target::sine:
      return {0, std::numbers::pi, 1, 2, 2};
    case Target::step:
    case Target::count:
      break;
  }
  return {0, 1, 3, 0.5, 0.5};
}

inline double evaluate(Target target, double x) {
  switch (target) {
    case Target::square:
      return x * x;
    case Target::sine:
      return std::sin(x);
    case Target::step:
    case Target::count:
      break;
  }
  return x < 0.5 ? 0 : 1;
}

/// The fraction of f's integral below x.
inline double target_cdf(Target target, double x) {
  switch (target) {
    case Target::square:
      return (x * x * x + 1) / 9;
    case Target::sine:
      return (1 - std::cos(x)) / 2;
    case Target::step:
    case Target::count:
      break;
  }
  return x < 0.5 ? 0 : 2 * x - 1;
}

}  // namespace lab05_tests
