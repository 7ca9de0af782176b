#pragma once

#include <cmath>

namespace carlo {

/// A running sum whose rounding error does not grow with the number of terms (Neumaier's form of
/// Kahan summation, which also survives a term larger than the sum).
class CompensatedSum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    error_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  /// An infinite term makes the sum infinite (and not NaN, as the correction would).
  double value() const { return std::isinf(sum_) ? sum_ : sum_ + error_; }

 private:
  double sum_ = 0;
  double error_ = 0;
};

}  // namespace carlo
