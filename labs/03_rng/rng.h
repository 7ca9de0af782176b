#pragma once

// Lab 03: random numbers. The contract: what each exercise takes and returns. Do not edit this
// file; your work goes into rng.cpp.

#include "support/error.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lab03 {

/// The lecture's linear congruential generator: x_{n+1} = (a x_n + b) mod 2^32.
class Lcg {
 public:
  static constexpr std::uint32_t a = 1664525, b = 1013904223;

  /// The seed is x_0, which is not returned itself.
  explicit Lcg(std::uint32_t seed) : x_(seed) {}

  /// Lab 3.1. The next number of the sequence; the first call returns x_1.
  std::uint32_t next();

  /// Lab 3.2. Leaves the generator where n calls of next() would, in O(log n) steps; any n.
  void discard(std::uint64_t n);

  /// The next out.size() numbers.
  void fill(std::span<std::uint32_t> out);

 private:
  std::uint32_t x_;
};

/// How a lagged Fibonacci generator combines x_{n-j} and x_{n-k}, in this order, modulo 2^32.
enum class Combine { add, subtract, exclusive_or };

struct Lags {
  int j = 0, k = 0;  ///< 0 < j < k
};

/// Lab 3.3. The k >= 1 words that a lagged Fibonacci generator starts from, made from one seed.
/// Equal seeds give equal words. At least one word is odd, whatever the seed; to ensure this the
/// lowest bit of one word may be set. All other bits, including those of this word, are 0 or 1
/// equally often, and the words look independent of each other and of all words of other seeds,
/// even neighbouring ones. You may use carlo::hash and carlo::mix (random/hash.h).
std::vector<std::uint32_t> first_words(std::uint64_t seed, int k);

/// A lagged Fibonacci generator: x_n = x_{n-j} (+, - or xor) x_{n-k} mod 2^32.
class LaggedFibonacci {
 public:
  /// `first` holds x_0 ... x_{k-1}, which are not returned. Throws carlo::Error unless 0 < j < k
  /// and there are k words.
  LaggedFibonacci(Lags lags, Combine combine, std::span<const std::uint32_t> first)
      : lags_(lags), combine_(combine), words_(first.begin(), first.end()) {
    if (lags.j <= 0 || lags.j >= lags.k || words_.size() != static_cast<std::size_t>(lags.k)) {
      throw carlo::Error("a lagged Fibonacci generator takes 0 < j < k and k first words");
    }
  }

  /// Lab 3.3. The next number; the first call returns x_k. Takes the same time for every k.
  std::uint32_t next();

  /// The next out.size() numbers.
  void fill(std::span<std::uint32_t> out);

 private:
  Lags lags_;
  Combine combine_;
  std::vector<std::uint32_t> words_;  ///< the last k numbers, as a ring
  std::size_t oldest_ = 0;            ///< position of x_{n-k} in the ring
};

/// PCG32 (XSH-RR 64/32), a modern generator: 2^63 streams of period 2^64. Streams whose numbers
/// differ only in high bits have many outputs in common. Source: O'Neill, "PCG: A family of simple
/// fast space-efficient statistically good algorithms for random number generation", 2014;
/// www.pcg-random.org.
class Pcg32 {
 public:
  static constexpr std::uint64_t multiplier = 6364136223846793005;

  /// Lab 3.4. Seeded like the reference implementation: increment 2 stream + 1, state 0, one step,
  /// the seed added to the state, one more step.
  Pcg32(std::uint64_t seed, std::uint64_t stream);

  /// Lab 3.4. The next number, made from the state s before the step: the low 32 bits of ((s >> 18)
  /// xor s) >> 27, rotated to the right by s >> 59. The step is an LCG's modulo 2^64: s becomes
  /// multiplier s + increment.
  std::uint32_t next();

  /// The next out.size() numbers.
  void fill(std::span<std::uint32_t> out);

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_ = 1;  ///< odd
};

/// Lab 3.5. A float in [0, 1), never 1: one of the 2^24 multiples of 2^-24, each from 256 words. It
/// does not decrease as the word grows.
float unit_float(std::uint32_t word);

/// Lab 3.5. A float in [a, b), never b and never below a: a + (b - a) unit_float(word), to within
/// two gaps between floats at the larger of |a| and |b|. a < b, any finite floats.
float float_between(std::uint32_t word, float a, float b);

/// A source of uniform 32-bit words.
using Words = std::function<std::uint32_t()>;

/// Lab 3.6. A whole number in [u..v], both ends included, u <= v: all of them exactly equally
/// likely when the words are uniform, for every range up to all 2^32 numbers. Draws fewer than two
/// words on average.
std::int32_t integer_between(std::int32_t u, std::int32_t v, const Words& next);

/// The outcome of a statistical test. A statistic can be too small as well as too large. Both tails
/// keep their digits however small they are: neither is 1 minus the other, which rounds to 0.
struct TestResult {
  double statistic = 0;
  double p_lower = 1;  ///< the probability that a perfect generator gives this value or a smaller
                       ///< one
  double p_upper = 1;  ///< ... this value or a larger one
};

/// Lab 3.7. Pearson's chi-square test of `counts` against `expected` (each > 0; as many as counts,
/// at least two). Nothing but their sum was estimated from the counts. Each tail is right to 1e-9
/// of itself, down to 1e-300. carlo::chi_square_lower and carlo::chi_square_upper
/// (stats/distributions.h) are the distribution.
TestResult chi_square(std::span<const std::int64_t> counts, std::span<const double> expected);

/// Lab 3.7. The chi-square test of `bits` bits of each word, 1 <= bits <= 16, counted from the bit
/// `lowest` (0 is the least significant; lowest + bits <= 32): every value should come equally
/// often.
TestResult equidistribution(std::span<const std::uint32_t> words, int lowest, int bits);

/// Given, for Lab 3.8: a signed integer that holds any product of two 64-bit ones.
__extension__ typedef __int128 Wide;

/// Given, for Lab 3.8: a vector of the lattice, and the scalar product of two.
struct Vector {
  Wide s, t;
};
inline Wide dot(const Vector& x, const Vector& y) {
  return x.s * y.s + x.t * y.t;
}

/// Lab 3.8. The spectral test in two dimensions for x -> (a x + b) mod c, exact: the squared length
/// nu_2^2 of the shortest integer vector (s, t), not both 0, with s + a t = 0 mod c. The pairs
/// (x_n, x_{n+1}) / c of a generator that visits every x lie on parallel lines at most 1 / nu_2
/// apart. A generator that visits only odd x, like RANDU, is measured by a mod c/2: x = 2 y + 1,
/// and y is an LCG of its own. 0 < a < c <= 2^32.
std::uint64_t spectral_2d(std::uint64_t a, std::uint64_t c);

}  // namespace lab03
