#include "battery.h"

#include <algorithm>
#include <array>
#include <cmath>

// Tests that sort: collisions (Knuth, section 3.3.2 I) and birthday spacings (Marsaglia; L'Ecuyer
// and Simard, "On the performance of birthday spacings tests with certain families of random number
// generators", 2001).

namespace lab03 {
namespace {

/// Sorts numbers of `bits` bits by their digits, 11 bits at a time.
void sort_digits(std::vector<std::uint64_t>& numbers, int bits) {
  constexpr int digit = 11;
  std::vector<std::uint64_t> other(numbers.size());
  for (int shift = 0; shift < bits; shift += digit) {
    std::array<std::size_t, (1 << digit) + 1> start{};
    const auto place = [&](std::uint64_t x) { return (x >> shift) & ((1 << digit) - 1); };
    for (const std::uint64_t x : numbers)
      ++start[place(x) + 1];
    for (std::size_t i = 1; i < start.size(); ++i)
      start[i] += start[i - 1];
    for (const std::uint64_t x : numbers)
      other[start[place(x)]++] = x;
    numbers.swap(other);
  }
}

/// The number of sorted numbers that equal the one before.
std::int64_t repeats(const std::vector<std::uint64_t>& sorted) {
  std::int64_t count = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] == sorted[i - 1]) ++count;
  }
  return count;
}

/// The points of a sample: `dimensions` words each, by their top `bits` bits.
std::vector<std::uint64_t> points(std::span<const std::uint32_t> words, std::size_t dimensions,
                                  int bits) {
  std::vector<std::uint64_t> result;
  for (std::size_t i = 0; i + dimensions <= words.size(); i += dimensions) {
    std::uint64_t point = 0;
    for (std::size_t d = 0; d < dimensions; ++d)
      point = point << bits | words[i + d] >> (32 - bits);
    result.push_back(point);
  }
  return result;
}

/// Repeated distances among n birthdays in a year of 2^bits days, roughly Poisson with mean n^3 /
/// (4 days). Summed over the rounds that fit into the sample; nothing where so many rounds would
/// show that the distribution is not exactly Poisson (L'Ecuyer and Simard's conditions, either of
/// which is enough).
Outcome birthdays(const Sample& sample, std::size_t dimensions, int bits, std::size_t most) {
  const std::size_t n = std::min(most, sample.words.size() / dimensions);
  const std::size_t rounds = sample.words.size() / (n * dimensions);
  const int total_bits = bits * static_cast<int>(dimensions);
  const double days = std::ldexp(1.0, total_bits);
  const double mean = std::pow(static_cast<double>(n), 3) / (4 * days);
  const auto many = static_cast<double>(rounds);
  const bool good = 8 * many * mean <= std::pow(days, 0.25) ||
                    4 * static_cast<double>(n) <= std::pow(days, 5.0 / 12) / std::cbrt(many);
  if (!good || n < 1024) return std::nullopt;
  std::int64_t equal = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    auto days_of_birth =
        points(sample.words.subspan(round * n * dimensions, n * dimensions), dimensions, bits);
    sort_digits(days_of_birth, total_bits);
    // The distance across the turn of the year counts too.
    const std::uint64_t last = days_of_birth.back();
    for (std::size_t i = n - 1; i > 0; --i)
      days_of_birth[i] -= days_of_birth[i - 1];
    days_of_birth[0] += (std::uint64_t{1} << total_bits) - last;
    sort_digits(days_of_birth, total_bits);
    equal += repeats(days_of_birth);
  }
  return poisson_result(equal, many * mean);
}

}  // namespace

// n points in k cells: n - (occupied cells) collisions. Their mean is n - k (1 - (1 - 1/k)^n), and
// for n << k they are nearly Poisson.
Outcome collision_test(const Sample& sample) {
  const std::size_t pairs = sample.words.size() / 2;
  const auto n = static_cast<double>(pairs);
  const double cells = 0x1p30;
  const double mean = n + cells * std::expm1(n * std::log1p(-1 / cells));
  if (mean < 2 || n > cells / 256) return std::nullopt;
  auto urns = points(sample.words, 2, 15);
  sort_digits(urns, 30);
  return poisson_result(repeats(urns), mean);
}

Outcome birthday_2d_test(const Sample& sample) {
  return birthdays(sample, 2, 20, std::size_t{1} << 14);
}

// Numbers of 31 bits always have even distances: no fair year of 2^32 days.
Outcome birthday_1d_test(const Sample& sample) {
  if (sample.bits < 32) return std::nullopt;
  return birthdays(sample, 1, 32, 2048);
}

}  // namespace lab03
