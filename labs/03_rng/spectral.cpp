#include "spectral.h"

#include "support/error.h"

#include <array>
#include <cmath>
#include <cstdlib>

namespace lab03 {
namespace {

/// Tries all s_{d-1}, ..., s_1, each no longer than what remains of the best square so far; s_0
/// follows.
class Search {
 public:
  Search(std::uint64_t a, std::uint64_t c, int dimensions)
      : c_(static_cast<std::int64_t>(c)), dimensions_(dimensions) {
    std::uint64_t power = 1;
    for (auto& p : powers_) {
      p = static_cast<std::int64_t>(power);
      power = power * (a % c) % c;  // both below 2^32
    }
    // Hermite: nu^2 <= gamma c^(2/d), gamma = (4/3)^(1/2), 2^(1/3), 2^(1/2).
    const std::array<double, 3> gamma = {std::sqrt(4.0 / 3), std::cbrt(2.0), std::sqrt(2.0)};
    const double bound = gamma[static_cast<std::size_t>(dimensions - 2)] *
                         std::pow(static_cast<double>(c), 2.0 / dimensions);
    best_ = static_cast<std::int64_t>(bound * (1 + 1e-12)) + 1;
  }

  DualVector result() {
    from(dimensions_ - 1, 0, 0, false);
    return {{shortest_.begin(), shortest_.begin() + dimensions_},
            static_cast<std::uint64_t>(best_)};
  }

 private:
  /// s_{dim} and below are free; `sum` is the contribution modulo c of those above, `squared` their
  /// square. A vector and its opposite are equivalent: the first nonzero entry is positive.
  void from(int dim, std::int64_t sum, std::int64_t squared, bool signed_already) {
    if (dim == 0) return close(sum, squared);
    const auto place = static_cast<std::size_t>(dim);
    const auto most = static_cast<std::int64_t>(std::sqrt(static_cast<double>(best_ - squared)));
    std::int64_t value = signed_already ? -most : 0;
    std::int64_t now = (sum + (value * powers_[place]) % c_ + c_) % c_;
    for (; value <= most; ++value) {
      s_[place] = value;
      if (squared + value * value <= best_)
        from(dim - 1, now, squared + value * value, signed_already || value != 0);
      now += powers_[place];
      if (now >= c_) now -= c_;
    }
  }

  /// s_0 is the number of least absolute value that makes the sum 0 modulo c; c itself if all
  /// others are 0.
  void close(std::int64_t sum, std::int64_t squared) {
    std::int64_t first = sum == 0 ? 0 : sum > c_ / 2 ? c_ - sum : -sum;
    if (squared == 0) first = c_;
    if (std::abs(first) > 3'000'000'000) return;
    const std::int64_t length = squared + first * first;
    if (length >= best_ && found_) return;
    if (length > best_) return;
    best_ = length;
    found_ = true;
    s_[0] = first;
    shortest_ = s_;
  }

  std::int64_t c_;
  int dimensions_;
  std::array<std::int64_t, 4> powers_{}, s_{}, shortest_{};
  std::int64_t best_ = 0;
  bool found_ = false;
};

}  // namespace

double DualVector::length() const {
  return std::sqrt(static_cast<double>(squared));
}

std::int64_t DualVector::planes(bool shifted) const {
  std::int64_t sum = shifted ? 0 : -1;
  for (const std::int64_t x : s)
    sum += std::abs(x);
  return sum;
}

DualVector shortest_dual_vector(std::uint64_t a, std::uint64_t c, int dimensions) {
  if (dimensions < 2 || dimensions > 4 || a == 0 || a >= c || c > std::uint64_t{1} << 32) {
    throw carlo::Error("the spectral test takes 0 < a < c <= 2^32 and 2 to 4 dimensions");
  }
  return Search(a, c, dimensions).result();
}

}  // namespace lab03
