#include "rng.h"

#include "random/hash.h"
#include "stats/distributions.h"

#include <bit>
#include <cmath>
#include <utility>

// Lab 03: random numbers, solved.

namespace lab03 {

// Lab 3.1 -----------------------------------------------------------------------------------------

std::uint32_t Lcg::next() {
  x_ = a * x_ + b;
  return x_;
}

// Lab 3.2 -----------------------------------------------------------------------------------------

// Brown, "Random number generation with arbitrary strides", 1994.
void Lcg::discard(std::uint64_t n) {
  std::uint32_t factor = a, summand = b;  // x -> factor x + summand makes 1, 2, 4, 8, ... steps
  for (; n != 0; n >>= 1) {
    if ((n & 1) != 0) x_ = factor * x_ + summand;
    summand *= factor + 1;
    factor *= factor;
  }
}

// Lab 3.3 -----------------------------------------------------------------------------------------

std::vector<std::uint32_t> first_words(std::uint64_t seed, int k) {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(k));
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = static_cast<std::uint32_t>(carlo::hash(seed, i) >> 32);
  words[0] |= 1;
  return words;
}

std::uint32_t LaggedFibonacci::next() {
  const std::size_t k = words_.size();
  std::size_t near = oldest_ + k - static_cast<std::size_t>(lags_.j);
  if (near >= k) near -= k;
  const std::uint32_t x = words_[near];
  std::uint32_t& y = words_[oldest_];
  y = combine_ == Combine::add ? x + y : combine_ == Combine::subtract ? x - y : x ^ y;
  if (++oldest_ == k) oldest_ = 0;
  return y;
}

// Lab 3.4 -----------------------------------------------------------------------------------------

Pcg32::Pcg32(std::uint64_t seed, std::uint64_t stream) : increment_(2 * stream + 1) {
  next();
  state_ += seed;
  next();
}

std::uint32_t Pcg32::next() {
  const std::uint64_t old = state_;
  state_ = multiplier * old + increment_;
  const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  return std::rotr(mixed, static_cast<int>(old >> 59));
}

// Lab 3.5 -----------------------------------------------------------------------------------------

float unit_float(std::uint32_t word) {
  return static_cast<float>(word >> 8) * 0x1p-24f;
}

// In double nothing overflows, and the only rounding that counts is the last one.
float float_between(std::uint32_t word, float a, float b) {
  const double width = static_cast<double>(b) - a;
  const auto x = static_cast<float>(a + width * unit_float(word));
  return x < b ? x : std::nextafter(b, a);
}

// Lab 3.6 -----------------------------------------------------------------------------------------

// Lemire, "Fast random integer generation in an interval", 2019. The product of a word and the
// number of values falls into one of `values` boxes 2^32 wide. A box holds floor or ceil(2^32 /
// values) products; without those whose low half is below 2^32 mod values, all boxes hold equally
// many.
std::int32_t integer_between(std::int32_t u, std::int32_t v, const Words& next) {
  const std::uint64_t values = static_cast<std::uint64_t>(std::int64_t{v} - u) + 1;
  std::uint64_t product = next() * values;
  if (static_cast<std::uint32_t>(product) < values) {
    const std::uint64_t left_over = (std::uint64_t{1} << 32) % values;
    while (static_cast<std::uint32_t>(product) < left_over)
      product = next() * values;
  }
  return static_cast<std::int32_t>(u + static_cast<std::int64_t>(product >> 32));
}

// Lab 3.7 -----------------------------------------------------------------------------------------

TestResult chi_square(std::span<const std::int64_t> counts, std::span<const double> expected) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double difference = static_cast<double>(counts[i]) - expected[i];
    statistic += difference * difference / expected[i];
  }
  const auto freedom = static_cast<double>(counts.size() - 1);
  return {statistic, carlo::chi_square_lower(statistic, freedom),
          carlo::chi_square_upper(statistic, freedom)};
}

TestResult equidistribution(std::span<const std::uint32_t> words, int lowest, int bits) {
  const std::size_t cells = std::size_t{1} << bits;
  std::vector<std::int64_t> counts(cells);
  for (const std::uint32_t word : words)
    ++counts[(word >> lowest) & (cells - 1)];
  const double each = static_cast<double>(words.size()) / static_cast<double>(cells);
  return chi_square(counts, std::vector<double>(cells, each));
}

// Lab 3.8 -----------------------------------------------------------------------------------------

namespace {

/// x / y to the nearest whole number, halves towards 0; y > 0.
Wide nearest_quotient(Wide x, Wide y) {
  const Wide magnitude = ((x < 0 ? -x : x) + (y - 1) / 2) / y;
  return x < 0 ? -magnitude : magnitude;
}

}  // namespace

// Gauss's reduction: Euclid's algorithm on vectors.
std::uint64_t spectral_2d(std::uint64_t a, std::uint64_t c) {
  Vector longer{static_cast<Wide>(c), 0}, shorter{-static_cast<Wide>(a), 1};
  for (;;) {
    if (dot(longer, longer) < dot(shorter, shorter)) std::swap(longer, shorter);
    const Wide times = nearest_quotient(dot(longer, shorter), dot(shorter, shorter));
    if (times == 0) return static_cast<std::uint64_t>(dot(shorter, shorter));
    longer = {longer.s - times * shorter.s, longer.t - times * shorter.t};
  }
}

}  // namespace lab03

#include "fills.h"  // given: fill(), loops over the next() above
