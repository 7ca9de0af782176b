#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lab01_tests {

/// Records the points at which a function is evaluated: their number, and the coordinates of the
/// first n.
class Recorder {
 public:
  Recorder(std::int64_t n, std::size_t dimensions)
      : dimensions_(dimensions), wanted_(static_cast<std::size_t>(n) * dimensions) {}

  /// A point of a different dimension counts, as NaN.
  void note(std::span<const double> x) {
    count_ += 1;
    for (std::size_t i = 0; i < dimensions_ && points_.size() < wanted_; ++i)
      points_.push_back(x.size() == dimensions_ ? x[i] : missing);
  }
  void note(double x) { note(std::span(&x, 1)); }

  /// Records nothing if it is the last point again.
  void note_once(std::span<const double> x) {
    if (last_.size() == x.size() && std::equal(x.begin(), x.end(), last_.begin())) return;
    last_.assign(x.begin(), x.end());
    note(x);
  }

  /// Wraps `f` so that its points are recorded; the recorder must outlive the result.
  std::function<double(double)> watch(std::function<double(double)> f) {
    return [this, f = std::move(f)](double x) {
      note(x);
      return f(x);
    };
  }

  double count() const { return count_; }
  /// Padded with NaN.
  std::vector<double> points() const {
    std::vector<double> all = points_;
    all.resize(wanted_, missing);
    return all;
  }

 private:
  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  std::size_t dimensions_, wanted_;
  double count_ = 0;
  std::vector<double> points_;
  std::vector<double> last_;
};

}  // namespace lab01_tests
