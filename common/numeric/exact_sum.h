#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace carlo {

/// A sum in fixed point: terms are rounded to a grid once, and additions are exact, so the sum does
/// not depend on their order nor on how they were split up among threads or machines.
class ExactSum {
 public:
  /// Adds `x` rounded to a multiple of `grid`, a power of two. |x| up to 2^112 grids; larger terms
  /// are cut off there.
  void add(double x, double grid) {
    constexpr double limit = 0x1p112;
    const double rounded = std::nearbyint(x / grid);
    const double above = rounded >= -limit ? rounded : -limit;
    units_ += integer(above <= limit ? above : limit);
  }
  void add(const ExactSum& other) { units_ += other.units_; }

  /// The sum in units of the grid, as two's complement: the low 32 bits first.
  std::array<std::uint32_t, 4> words() const {
    std::array<std::uint32_t, 4> words;
    for (unsigned i = 0; i < 4; ++i)
      words[i] = static_cast<std::uint32_t>(units_ >> (32 * i));
    return words;
  }
  static ExactSum from_words(const std::array<std::uint32_t, 4>& words) {
    ExactSum sum;
    for (unsigned i = 4; i-- > 0;)
      sum.units_ = static_cast<Int128>(static_cast<Word128>(sum.units_) << 32 | words[i]);
    return sum;
  }

  double value(double grid) const { return static_cast<double>(units_) * grid; }

  friend bool operator==(const ExactSum&, const ExactSum&) = default;

 private:
  __extension__ using Int128 = __int128;
  __extension__ using Word128 = unsigned __int128;

  /// An integer given as a double, below 2^113. What the compiler's library does for a cast takes
  /// longer than all else here.
  static Int128 integer(double x) {
    if (std::abs(x) < 0x1p53) return static_cast<std::int64_t>(x);
    const auto word = std::bit_cast<std::uint64_t>(x);
    const auto shift = static_cast<int>(word >> 52 & 0x7FF) - 1075;
    constexpr std::uint64_t leading = std::uint64_t{1} << 52;
    const Int128 size = static_cast<Int128>((word & (leading - 1)) | leading) << shift;
    return x < 0 ? -size : size;
  }

  Int128 units_ = 0;
};

}  // namespace carlo
