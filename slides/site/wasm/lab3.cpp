// Lab 3: the planes of any linear congruential generator, and the tests that catch it.

#include "battery.h"
#include "call.h"
#include "spectral.h"

#include <algorithm>
#include <bit>

namespace site {
namespace {

using namespace lab03;

/// x -> (a x + b) mod c, 0 < a < c <= 2^32, 0 <= b < c. Its numbers are x / c.
struct AnyLcg {
  std::uint64_t a, b, c, x;

  /// From four arguments: a, b, c, x_0.
  explicit AnyLcg(const Arguments& given)
      : a(number(given[0])), b(number(given[1])), c(number(given[2])), x(number(given[3]) % c) {}

  static std::uint64_t number(double value) { return static_cast<std::uint64_t>(value); }
  std::uint64_t next() { return x = (a * x + b) % c; }
  double uniform() { return static_cast<double>(next()) / static_cast<double>(c); }
};

/// a, b, c, x_0, count: triples (x_n, x_{n+1}, x_{n+2}) / c that do not overlap.
Numbers triples(const Arguments& given) {
  AnyLcg lcg(given);
  Numbers xyz(3 * given.index(4));
  for (double& coordinate : xyz)
    coordinate = lcg.uniform();
  return xyz;
}

/// a, b, c, dimensions (2 to 4): the distance nu of the spectral test, the number of planes that
/// meet the cube, at most, and the vector across them.
Numbers spectral(const Arguments& given) {
  const DualVector dual = shortest_dual_vector(AnyLcg::number(given[0]), AnyLcg::number(given[2]),
                                               static_cast<int>(given[3]));
  Numbers results = {dual.length(), static_cast<double>(dual.planes(given[1] != 0))};
  for (const std::int64_t x : dual.s)
    results.push_back(static_cast<double>(x));
  return results;
}

/// a, c: nu_2 by Lab 3.8, exactly.
Numbers spectral_plane(const Arguments& given) {
  const std::uint64_t squared = spectral_2d(AnyLcg::number(given[0]), AnyLcg::number(given[1]));
  return {std::sqrt(static_cast<double>(squared))};
}

/// The first n words, the numbers at the top as labs/03_rng/generators.h has them, and how many
/// bits they have.
std::vector<std::uint32_t> words_of(const Arguments& given, std::size_t n, int& bits) {
  AnyLcg lcg(given);
  bits = static_cast<int>(std::bit_width(lcg.c - 1));
  std::vector<std::uint32_t> words(n);
  for (std::uint32_t& word : words)
    word = static_cast<std::uint32_t>(lcg.next() << (32 - bits));
  return words;
}

/// a, b, c, x_0, test, log2 of the number of words: the two-sided p-value; -1 if the test has no
/// verdict on as many words.
Numbers battery_test(const Arguments& given) {
  const RandomnessTest& test = battery().at(given.index(4));
  if (given[5] > test.most_log2) return {-1};
  int bits = 0;
  const std::vector<std::uint32_t> words = words_of(given, std::size_t{1} << given.index(5), bits);
  const Outcome outcome = test.run({words, bits, {24, 55}});
  return {outcome ? two_sided(*outcome) : -1};
}

/// a, b, c, x_0, N, runs: the RMS error of the mean of x over N numbers, and of the volume of the
/// ball octant over N triples; runs go on where the one before stopped.
Numbers integral_errors(const Arguments& given) {
  AnyLcg lcg(given);
  const std::int64_t n = given.whole(4), runs = given.whole(5);
  const double share = 1 / static_cast<double>(n);
  const auto mean = [&] {
    double sum = 0;
    for (std::int64_t i = 0; i < n; ++i)
      sum += lcg.uniform();
    return sum * share;
  };
  const auto octant = [&] {
    double inside = 0;
    for (std::int64_t i = 0; i < n; ++i) {
      const double x = lcg.uniform(), y = lcg.uniform(), z = lcg.uniform();
      inside += x * x + y * y + z * z < 1 ? 1 : 0;
    }
    return inside * share;
  };
  const double first = rms_error(runs, 0.5, mean);
  return {first, rms_error(runs, 0.52359877559829887, octant)};
}

const Function functions[] = {{"3.triples", triples},
                              {"3.spectral", spectral},
                              {"3.spectral_plane", spectral_plane},
                              {"3.test", battery_test},
                              {"3.integral", integral_errors}};

}  // namespace
}  // namespace site
