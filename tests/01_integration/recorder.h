#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace lab01_tests {

/// Notes where a function of one variable is evaluated, and the values that it gives.
class Recorder {
 public:
  /// `f`, watched; the recorder must outlive it.
  std::function<double(double)> watch(std::function<double(double)> f) {
    return [this, f = std::move(f)](double x) {
      const double y = f(x);
      if (points_.size() < most_kept) points_.push_back(x);
      count_ += 1;
      sum_ += y;
      if (x < lowest_) lowest_ = x;
      if (x > highest_) highest_ = x;
      return y;
    };
  }

  double count() const { return count_; }
  double lowest() const { return count_ > 0 ? lowest_ : 0; }
  double highest() const { return count_ > 0 ? highest_ : 0; }
  /// The mean of the values; 0 when there were none.
  double mean() const { return count_ > 0 ? static_cast<double>(sum_ / count_) : 0; }
  const std::vector<double>& points() const { return points_; }

 private:
  static constexpr std::size_t most_kept = 2'000'000;
  double count_ = 0;
  long double sum_ = 0;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
  std::vector<double> points_;
};

}  // namespace lab01_tests
