#include "battery.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

// Tests that compute modulo 2: ranks of matrices (Marsaglia and Tsay, "Matrices and the structure
// of random number sequences", 1985) and linear complexity (Massey, "Shift-register synthesis and
// BCH decoding", 1969).

namespace lab03 {
namespace {

using Matrix = std::array<std::uint64_t, 64>;

int rank(Matrix rows) {
  int rank = 0;
  for (int column = 0; column < 64; ++column) {
    const std::uint64_t bit = std::uint64_t{1} << column;
    const auto below = rows.begin() + rank;
    const auto pivot =
        std::find_if(below, rows.end(), [bit](std::uint64_t row) { return (row & bit) != 0; });
    if (pivot == rows.end()) continue;
    std::iter_swap(below, pivot);
    for (auto row = below + 1; row != rows.end(); ++row) {
      if ((*row & bit) != 0) *row ^= *below;
    }
    ++rank;
  }
  return rank;
}

/// The probability that a random 64 x 64 matrix has a rank of at most 62.
double deficient_by_two() {
  double full = 1;
  for (int i = 1; i <= 64; ++i)
    full *= 1 - std::ldexp(1.0, -i);
  // Rank n - 1: a factor of 2^-1 (1 - 2^-n) / (1 - 2^-1)^2 to the first approximation; exactly
  // 2^-1 prod_{i=0}^{n-2} (1 - 2^{i-n})^2 / (1 - 2^{i-n+1}).
  double one_less = 0.5;
  for (int i = 0; i <= 62; ++i)
    one_less *= std::pow(1 - std::ldexp(1.0, i - 64), 2) / (1 - std::ldexp(1.0, i - 63));
  return 1 - full - one_less;
}

/// The number of matrices that fall short of full rank by two or more is binomial.
Outcome ranks(std::size_t matrices, Matrix (*make)(const Sample&, std::size_t),
              const Sample& sample) {
  if (matrices < 1) return std::nullopt;
  static const double p = deficient_by_two();
  std::int64_t short_by_two = 0;
  for (std::size_t m = 0; m < matrices; ++m) {
    if (rank(make(sample, m)) <= 62) ++short_by_two;
  }
  return binomial_result(short_by_two, static_cast<std::int64_t>(matrices), p);
}

Matrix of_lowest_bits(const Sample& sample, std::size_t index) {
  Matrix rows{};
  const auto words = sample.words.subspan(4096 * index, 4096);
  for (std::size_t i = 0; i < 4096; ++i) {
    const std::uint64_t bit = words[i] >> (32 - sample.bits) & 1;
    rows[i / 64] |= bit << (i % 64);
  }
  return rows;
}

Matrix of_words(const Sample& sample, std::size_t index) {
  Matrix rows{};
  const auto words = sample.words.subspan(128 * index, 128);
  for (std::size_t i = 0; i < 64; ++i)
    rows[i] = std::uint64_t{words[2 * i]} << 32 | words[2 * i + 1];
  return rows;
}

/// A polynomial modulo 2, or a sequence of bits.
using Bits = std::vector<std::uint64_t>;

/// target ^= source shifted up by `shift`.
void add_shifted(Bits& target, const Bits& source, std::size_t shift) {
  const std::size_t words = shift / 64, bits = shift % 64;
  for (std::size_t i = 0; i + words < target.size(); ++i) {
    target[i + words] ^= source[i] << bits;
    if (bits != 0 && i + words + 1 < target.size())
      target[i + words + 1] ^= source[i] >> (64 - bits);
  }
}

/// The length of the shortest linear feedback shift register that gives the n bits, by Berlekamp
/// and Massey. `reversed` holds the bits seen so far, the latest one lowest.
std::size_t linear_complexity(const Sample& sample) {
  const std::size_t n = sample.words.size();
  const std::size_t size = n / 64 + 2;
  Bits connection(size), before(size), reversed(size);
  connection[0] = before[0] = 1;
  std::size_t length = 0, since = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t used = std::min(size, i / 64 + 1);
    for (std::size_t w = used; w-- > 0;)
      reversed[w] = reversed[w] << 1 | (w > 0 ? reversed[w - 1] >> 63 : 0);
    reversed[0] |= sample.words[i] >> (32 - sample.bits) & 1;
    std::uint64_t discrepancy = 0;
    for (std::size_t w = 0; w < std::min(used, length / 64 + 1); ++w)
      discrepancy ^= connection[w] & reversed[w];
    if (std::popcount(discrepancy) % 2 == 0) {
      ++since;
    } else if (2 * length <= i) {
      const Bits old = connection;
      add_shifted(connection, before, since);
      before = old;
      length = i + 1 - length;
      since = 1;
    } else {
      add_shifted(connection, before, since);
      ++since;
    }
  }
  return length;
}

}  // namespace

Outcome rank_low_bit_test(const Sample& sample) {
  if (sample.words.size() < 16 * 4096) return std::nullopt;
  return ranks(sample.words.size() / 4096, of_lowest_bits, sample);
}

Outcome rank_words_test(const Sample& sample) {
  if (sample.words.size() < 16 * 128 || sample.bits < 32) return std::nullopt;
  return ranks(sample.words.size() / 128, of_words, sample);
}

// A fraction 2^min(2n - 2L, 2L - 1) / 2^n of all sequences of n bits has complexity L > 0 (Rueppel
// 1986).
Outcome linear_complexity_test(const Sample& sample) {
  const std::size_t n = sample.words.size();
  if (n < 1024) return std::nullopt;
  const auto length = static_cast<std::int64_t>(linear_complexity(sample));
  const auto bits = static_cast<std::int64_t>(n);
  const auto share = [bits](std::int64_t l) {
    if (l == 0) return std::ldexp(1.0, static_cast<int>(-bits));
    return std::ldexp(1.0, static_cast<int>(std::min(2 * bits - 2 * l, 2 * l - 1) - bits));
  };
  TestResult result{static_cast<double>(length), 0, 0};
  // Beyond 600 from the centre the probabilities are 0 in double.
  for (std::int64_t l = std::max<std::int64_t>(0, bits / 2 - 600);
       l <= std::min(bits, bits / 2 + 600); ++l) {
    (l <= length ? result.p_lower : result.p_upper) += share(l);
  }
  result.p_upper += share(length);
  return result;
}

}  // namespace lab03
