#pragma once

#include <cmath>

namespace carlo {

/// A sum in fixed point: terms are rounded to a grid once, and additions are exact, so the sum does
/// not depend on their order nor on how they were split up among threads or machines.
class ExactSum {
 public:
  /// Adds `x` rounded to a multiple of `grid`, a power of two. |x| up to 2^112 grids; larger terms
  /// are cut off there.
  void add(double x, double grid) {
    constexpr double limit = 0x1p112;
    units_ += static_cast<Int128>(std::fmin(limit, std::fmax(-limit, std::nearbyint(x / grid))));
  }
  void add(const ExactSum& other) { units_ += other.units_; }

  double value(double grid) const { return static_cast<double>(units_) * grid; }

  friend bool operator==(const ExactSum&, const ExactSum&) = default;

 private:
  __extension__ using Int128 = __int128;
  Int128 units_ = 0;
};

}  // namespace carlo
