#include "stratification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

// Lab 04: stratification, solved.

namespace lab04 {

// Lab 4.1 -----------------------------------------------------------------------------------------

double stratified_average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  double sum = 0;
  for (std::int64_t i = 0; i < n; ++i)
    sum += f((static_cast<double>(i) + rng.uniform()) / static_cast<double>(n));
  return sum / static_cast<double>(n);
}

// Lab 4.2 -----------------------------------------------------------------------------------------

float place_in_stratum(std::int32_t i, std::int32_t n, float u) {
  float x = static_cast<float>((static_cast<double>(i) + static_cast<double>(u)) / n);
  // A float has 24 bits and n has 21: their product is exact in double.
  while (static_cast<double>(x) * n >= i + 1.0)
    x = std::nextafter(x, 0.0f);
  while (static_cast<double>(x) * n < i)
    x = std::nextafter(x, 1.0f);
  return x;
}

// Lab 4.3 -----------------------------------------------------------------------------------------

std::vector<Point> jittered(std::int64_t columns, std::int64_t rows, carlo::Rng& rng) {
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(columns * rows));
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      const double x = static_cast<double>(column) + rng.uniform();
      const double y = static_cast<double>(row) + rng.uniform();
      points.push_back({x / static_cast<double>(columns), y / static_cast<double>(rows)});
    }
  }
  return points;
}

// Lab 4.4 -----------------------------------------------------------------------------------------

std::vector<double> latin_hypercube(std::int64_t n, std::int64_t dimensions, carlo::Rng& rng) {
  const auto count = static_cast<std::size_t>(n);
  const auto d = static_cast<std::size_t>(dimensions);
  std::vector<std::size_t> strata(count);
  std::iota(strata.begin(), strata.end(), std::size_t{0});
  std::vector<double> points(count * d);
  for (std::size_t k = 0; k < d; ++k) {
    // Durstenfeld, "Algorithm 235: Random permutation", 1964, from the last element down.
    for (std::size_t left = count; left > 0; --left) {
      const auto pick = static_cast<std::size_t>(rng.uniform() * static_cast<double>(left));
      std::swap(strata[pick], strata[left - 1]);
      points[(left - 1) * d + k] =
          (static_cast<double>(strata[left - 1]) + rng.uniform()) / static_cast<double>(n);
    }
  }
  return points;
}

// Lab 4.5 -----------------------------------------------------------------------------------------

namespace {

/// Mean and spread of some numbers, by Welford's update.
struct Moments {
  double count = 0, mean = 0, squares = 0;  ///< squares: sum of (x - mean)^2

  void add(double x) {
    count += 1;
    const double from_old_mean = x - mean;
    mean += from_old_mean / count;
    squares += from_old_mean * (x - mean);
  }
  double variance() const { return count < 2 ? 0 : squares / (count - 1); }
  double variance_of_mean() const { return count < 2 ? 0 : variance() / count; }
};

}  // namespace

StratifiedEstimate stratified_estimate(const Function2d& f, std::int64_t columns, std::int64_t rows,
                                       std::int64_t per_cell, carlo::Rng& rng) {
  const auto wide = static_cast<double>(columns), high = static_cast<double>(rows);
  Moments means, within;  // over the cells: their means; the variances of these means
  double squares = 0;     // of all values about the means of their cells
  for (std::int64_t cell = 0; cell < columns * rows; ++cell) {
    const std::int64_t column = cell % columns, row = cell / columns;
    Moments values;
    for (std::int64_t i = 0; i < per_cell; ++i) {
      const double x = (static_cast<double>(column) + rng.uniform()) / wide;
      const double y = (static_cast<double>(row) + rng.uniform()) / high;
      values.add(f(x, y));
    }
    means.add(values.mean);
    within.add(values.variance_of_mean());
    squares += values.squares;
  }
  const double n = means.count * static_cast<double>(per_cell);
  const double variance = within.mean / means.count;
  // The mean of (y - value)^2 is less than the variance over the square by the variance of the
  // value.
  const double spread = (squares + static_cast<double>(per_cell) * means.squares) / n;
  return {means.mean, std::sqrt(variance), std::sqrt((spread + variance) / n)};
}

// Lab 4.6 -----------------------------------------------------------------------------------------

namespace {

/// Press and Farrar, "Recursive stratified sampling for multidimensional Monte Carlo integration",
/// Computers in Physics 4, 1990 (MISER); but boxes with few points are halved without exploring.
class Recursion {
 public:
  Recursion(const FunctionNd& f, std::size_t dimensions, carlo::Rng& rng,
            std::vector<Stratum>* strata)
      : f_(f),
        lower_(dimensions, 0.0),
        upper_(dimensions, 1.0),
        x_(dimensions),
        rng_(rng),
        strata_(strata) {}

  struct Average {
    double value = 0, variance = 0;
  };

  /// The average over the current box from at most n evaluations.
  Average estimate(std::int64_t n) {
    if (n < 2 * fewest) return plain(n);
    const std::int64_t spent = n < worth_exploring ? 0 : n / 32;
    const Split split = spent > 0 ? explore(spent) : longest_side();
    const std::int64_t left = n - spent;
    const auto wanted =
        static_cast<std::int64_t>(std::llround(split.share * static_cast<double>(left)));
    const std::int64_t lower_points = std::clamp(wanted, fewest, left - fewest);

    const double low = lower_[split.axis], high = upper_[split.axis], middle = (low + high) / 2;
    upper_[split.axis] = middle;
    const Average a = estimate(lower_points);
    upper_[split.axis] = high;
    lower_[split.axis] = middle;
    const Average b = estimate(left - lower_points);
    lower_[split.axis] = low;
    return {(a.value + b.value) / 2, (a.variance + b.variance) / 4};
  }

 private:
  static constexpr std::int64_t fewest = 2, worth_exploring = 512;

  struct Split {
    std::size_t axis = 0;
    double share = 0.5;  ///< fraction of the points for the lower half
  };

  double value_at_random_point() {
    for (std::size_t k = 0; k < x_.size(); ++k)
      x_[k] = lower_[k] + (upper_[k] - lower_[k]) * rng_.uniform();
    return f_(x_);
  }

  Average plain(std::int64_t n) {
    Moments values;
    for (std::int64_t i = 0; i < n; ++i)
      values.add(value_at_random_point());
    if (strata_ != nullptr) strata_->push_back({lower_, upper_, n});
    return {values.mean, values.variance_of_mean()};
  }

  Split longest_side() const {
    Split split;
    for (std::size_t k = 1; k < x_.size(); ++k) {
      if (upper_[k] - lower_[k] > upper_[split.axis] - lower_[split.axis]) split.axis = k;
    }
    return split;
  }

  Split explore(std::int64_t points) {
    std::vector<std::array<Moments, 2>> halves(x_.size());
    for (std::int64_t i = 0; i < points; ++i) {
      const double value = value_at_random_point();
      for (std::size_t k = 0; k < x_.size(); ++k)
        halves[k][x_[k] < (lower_[k] + upper_[k]) / 2 ? 0 : 1].add(value);
    }
    // With strata the error falls about as 1/n, and a half's best share grows as variance^(1/3).
    // A quarter is the least: a few points that saw no edge do not prove that there is none.
    Split best = longest_side();
    double best_sum = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double a = std::cbrt(halves[k][0].variance()), b = std::cbrt(halves[k][1].variance());
      if (a + b < best_sum && a + b > 0) {
        best_sum = a + b;
        best = {k, std::clamp(a / (a + b), 0.25, 0.75)};
      }
    }
    return best;
  }

  const FunctionNd& f_;
  std::vector<double> lower_, upper_, x_;
  carlo::Rng& rng_;
  std::vector<Stratum>* strata_;
};

}  // namespace

Estimate recursive_stratification(const FunctionNd& f, std::int64_t dimensions, std::int64_t n,
                                  carlo::Rng& rng, std::vector<Stratum>* strata) {
  Recursion recursion(f, static_cast<std::size_t>(dimensions), rng, strata);
  const auto [value, variance] = recursion.estimate(n);
  return {value, std::sqrt(variance)};
}

}  // namespace lab04
