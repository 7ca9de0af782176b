#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace carlo {

/// A sum of doubles that depends neither on their order nor on how they were split among threads or
/// machines, whatever their range. Terms are cut at fixed places, every 32 bits, into digits, and
/// digits of the same place are added as integers, without carries. The three highest places that
/// any term has reached are kept, so the sum is accurate to 2^-64 of its largest term; everything
/// below is cut off, always in the same way. Up to 2^31 terms.
/// Idea: Demmel and Nguyen, "Parallel reproducible summation", IEEE Transactions on Computers
/// 64(7), 2015.
class ExactSum {
 public:
  /// Adds a finite x.
  void add(double x) {
    add(1, [x](std::size_t) { return x; });
  }

  /// Adds x(0), x(1), ... x(n - 1), all finite; faster than one by one.
  template <class X>
  void add(std::size_t n, const X& x) {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i)
      most = std::max(most, std::abs(x(i)));
    if (most == 0) return;
    raise(place_of(parts_of(most).exponent + 52) - (places - 1));
    std::array<std::uint64_t, places> digits = digits_;
    for (std::size_t i = 0; i < n; ++i) {
      const double value = x(i);
      const Parts parts = parts_of(value);
      // Relative to the lowest place; bits below it are cut off, there are none above the highest.
      const int shift = parts.exponent - bits * lowest_;
      const bool up = shift >= 0;
      const std::uint64_t low =
          up ? parts.mantissa << shift : parts.mantissa >> std::min(-shift, 63);
      const std::uint64_t high = up ? parts.mantissa >> 1 >> (63 - shift) : 0;
      const std::uint64_t sign = value < 0 ? ~std::uint64_t{0} : 0;
      digits[0] += ((low & 0xFFFFFFFF) ^ sign) - sign;
      digits[1] += (low >> bits ^ sign) - sign;
      digits[2] += (high ^ sign) - sign;
    }
    digits_ = digits;
  }

  void add(const ExactSum& other) {
    if (other.lowest_ == none) return;
    raise(other.lowest_);
    for (int i = std::max(0, lowest_ - other.lowest_); i < places; ++i) {
      digits_[static_cast<std::size_t>(other.lowest_ + i - lowest_)] +=
          other.digits_[static_cast<std::size_t>(i)];
    }
  }

  double value() const {
    double sum = 0;
    for (int i = 0; i < places; ++i)
      sum += std::ldexp(
          static_cast<double>(static_cast<std::int64_t>(digits_[static_cast<std::size_t>(i)])),
          bits * (std::max(lowest_, least) + i));
    return sum;
  }

  /// The complete state: the place of the lowest digit, then the digits in two's complement, the
  /// low half of each first.
  static constexpr std::size_t words_count = 7;
  std::array<std::uint32_t, words_count> words() const {
    std::array<std::uint32_t, words_count> words{static_cast<std::uint32_t>(lowest_)};
    for (std::size_t i = 0; i < digits_.size(); ++i) {
      words[1 + 2 * i] = static_cast<std::uint32_t>(digits_[i]);
      words[2 + 2 * i] = static_cast<std::uint32_t>(digits_[i] >> bits);
    }
    return words;
  }
  /// Accepts any words.
  static ExactSum from_words(const std::array<std::uint32_t, words_count>& words) {
    ExactSum sum;
    sum.lowest_ = std::clamp(static_cast<std::int32_t>(words[0]), none, greatest);
    for (std::size_t i = 0; i < sum.digits_.size(); ++i) {
      sum.digits_[i] = std::uint64_t{words[2 + 2 * i]} << bits | words[1 + 2 * i];
    }
    return sum;
  }

  friend bool operator==(const ExactSum&, const ExactSum&) = default;

 private:
  static constexpr int bits = 32, places = 3;
  /// Places of the lowest digit: doubles lie between 2^-1074 and 2^1024. `none` before the first.
  static constexpr std::int32_t least = -36, greatest = 32, none = least - 1;

  /// Returns the place of the bit with this value, a power of two: the next multiple below.
  static constexpr int place_of(int exponent) { return exponent >> 5; }

  /// |x| = mantissa 2^exponent, also for subnormal numbers.
  struct Parts {
    std::uint64_t mantissa;
    int exponent;
  };
  static Parts parts_of(double x) {
    const auto word = std::bit_cast<std::uint64_t>(std::abs(x));
    const auto field = static_cast<int>(word >> 52);
    constexpr std::uint64_t leading = std::uint64_t{1} << 52;
    return {(word & (leading - 1)) | (field > 0 ? leading : 0), std::max(field, 1) - 1075};
  }

  /// Raises the places until the lowest is at least `lowest`.
  void raise(int lowest) {
    if (lowest <= lowest_) return;
    const int up = lowest_ == none ? places : std::min(lowest - lowest_, places);
    for (int i = 0; i < places; ++i)
      digits_[static_cast<std::size_t>(i)] =
          i + up < places ? digits_[static_cast<std::size_t>(i + up)] : 0;
    lowest_ = lowest;
  }

  std::array<std::uint64_t, places> digits_{};  ///< in two's complement
  std::int32_t lowest_ = none;
};

}  // namespace carlo
