#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {

/// The contributions of light paths to the pixels of an image, summed as whole numbers so that
/// the bits do not depend on the order in which threads add.
class Splats {
 public:
  /// Sums hold up to 2^63 `unit`.
  Splats(std::size_t pixels, double unit) : sums_(pixels), unit_(unit) {}

  double unit() const { return unit_; }

  /// Callable from any thread. The sum must stay below 2^63.
  void add(std::size_t pixel, const std::array<std::int64_t, 3>& units) {
    for (std::size_t c = 0; c < 3; ++c) {
      sums_[pixel][c].fetch_add(units[c], std::memory_order_relaxed);
    }
  }

  /// Not while another thread adds.
  double sum(std::size_t pixel, std::size_t channel) const {
    return static_cast<double>(sums_[pixel][channel].load(std::memory_order_relaxed)) * unit_;
  }

 private:
  std::vector<std::array<std::atomic<std::int64_t>, 3>> sums_;
  double unit_;
};

}  // namespace carlo
