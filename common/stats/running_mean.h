#pragma once

#include <cmath>

namespace carlo {

/// The mean and spread of successive numbers, by Welford's update.
class RunningMean {
 public:
  void add(double x) {
    n_ += 1;
    const double d = x - mean_;
    mean_ += d / n_;
    squares_ += d * (x - mean_);
  }

  double count() const { return n_; }
  double mean() const { return mean_; }
  /// The standard deviation of one number, and of the mean; needs at least two numbers.
  double deviation() const { return std::sqrt(squares_ / (n_ - 1)); }
  double error() const { return deviation() / std::sqrt(n_); }

 private:
  double n_ = 0, mean_ = 0, squares_ = 0;
};

}  // namespace carlo
