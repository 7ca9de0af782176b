// The vector kernel's sample points on all instruction sets of this machine: their construction
// agrees with sampling/sobol.h bit for bit, and their distribution is compared with the scalar
// sampler's.

#include "lane_records.h"
#include "random/hash.h"
#include "random/to_float.h"
#include "sampling/samplers.h"
#include "sampling/sobol.h"
#include "walsh.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// These follow the two headers above, which compile them anew.
#include "renderer/lanes/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Applies a function to each word, or pair of words, of arrays whose size is a multiple of every
/// number of lanes.
HWY_ATTR void second_coordinates(const std::vector<std::uint32_t>& words,
                                 std::vector<std::uint32_t>& result) {
  for (std::size_t i = 0; i < words.size(); i += lanes)
    hn::StoreU(second_coordinate(hn::LoadU(du_, &words[i])), du_, &result[i]);
}

HWY_ATTR void sobol_points(const std::vector<std::uint32_t>& indices,
                           const std::vector<std::uint32_t>& words, std::vector<float>& x,
                           std::vector<float>& y) {
  for (std::size_t i = 0; i < indices.size(); i += lanes) {
    const U reversed = reverse_bits(hn::LoadU(du_, &indices[i]));
    const V2 p = sobol_2d(reversed, hn::LoadU(du_, &words[i]));
    hn::StoreU(p.x, d_, &x[i]);
    hn::StoreU(p.y, d_, &y[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(second_coordinates);
HWY_EXPORT(sobol_points);

namespace {

/// "lowbias32", the scalar twin of the kernel's mix().
std::uint32_t low_bias(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7FEB352D;
  x = (x ^ x >> 15) * 0x846CA68B;
  return x ^ x >> 16;
}

/// The scalar twin of the kernel's second_word().
std::uint32_t second_word(std::uint32_t k) {
  return (k ^ k >> 15) * 0x2C1B3C6D;
}

/// Numbers without a pattern.
std::vector<std::uint32_t> words(std::uint64_t seed, std::size_t count) {
  std::vector<std::uint32_t> result;
  for (std::uint64_t i = 0; i < count; ++i)
    result.push_back(static_cast<std::uint32_t>(carlo::hash(seed, i)));
  return result;
}

/// The kernel's points 0 to n - 1 of one pair; n is a multiple of 64.
std::vector<carlo::Vec2> lane_points(std::uint32_t n, std::uint32_t word) {
  std::vector<std::uint32_t> indices(n);
  for (std::uint32_t i = 0; i < n; ++i)
    indices[i] = i;
  std::vector<float> x(n), y(n);
  HWY_DYNAMIC_DISPATCH(sobol_points)
  (indices, std::vector<std::uint32_t>(n, word), x, y);
  std::vector<carlo::Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i)
    points[i] = {x[i], y[i]};
  return points;
}

/// The random words of a draw's two pairs: of a vertex, or of two vertices in a row.
std::array<std::uint32_t, 2> words_of(std::uint64_t draw, bool one_vertex) {
  const auto key = static_cast<std::uint32_t>(carlo::hash(4, draw));
  const std::uint32_t k = low_bias(key);
  return {k, one_vertex ? second_word(k) : low_bias(key + 0x9E3779B1)};
}

/// The root mean square error, over many words, of the mean of exp(x + y) over n points.
double smooth_error(std::uint32_t n) {
  constexpr std::uint32_t draws = 400;
  const double exact = (std::exp(1.0) - 1) * (std::exp(1.0) - 1);
  double sum = 0;
  for (const std::uint32_t word : words(5, draws)) {
    double mean = 0;
    for (const carlo::Vec2 p : lane_points(n, word))
      mean += std::exp(static_cast<double>(p.x) + static_cast<double>(p.y)) / n;
    sum += (mean - exact) * (mean - exact) / draws;
  }
  return std::sqrt(sum);
}

}  // namespace

// Both sides are linear over the bits, so equality on the words of one bit is equality on all.
TEST_CASE("The second Sobol' coordinate in lanes is sobol_second()") {
  std::vector<std::uint32_t> x = words(1, 1024);
  for (std::size_t bit = 0; bit < 32; ++bit)
    x[bit] = std::uint32_t{1} << bit;
  x[32] = 0;
  instruction_sets::on_all([&] {
    std::vector<std::uint32_t> y(x.size());
    HWY_DYNAMIC_DISPATCH(second_coordinates)(x, y);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK(y[i] == carlo::sobol_second(carlo::reverse_bits(x[i])));
  });
}

TEST_CASE("Sobol' points in lanes are shuffled as in sampling/sobol.h, and scrambled") {
  const std::vector<std::uint32_t> random_words = words(2, 1024);
  std::vector<std::uint32_t> indices = words(3, 1024);
  for (std::uint32_t i = 0; i < 512; ++i)
    indices[i] = i;
  const auto scrambled = [](std::uint32_t x, std::uint32_t which) {
    return x ^ (x >> 1 & which) ^ (x >> 2 & which << 11);
  };
  instruction_sets::on_all([&] {
    std::vector<float> x(indices.size()), y(indices.size());
    HWY_DYNAMIC_DISPATCH(sobol_points)(indices, random_words, x, y);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::uint32_t k = random_words[i], shift = k * 0xB5297A4D;
      const std::uint32_t first = carlo::nested_hash(carlo::reverse_bits(indices[i]), k);
      const std::uint32_t second = carlo::sobol_second(carlo::reverse_bits(first));
      CHECK(x[i] == carlo::to_float(scrambled(first, shift)));
      CHECK(y[i] == carlo::to_float(scrambled(second, k) ^ shift));
    }
  });
}

TEST_CASE("Aligned runs of 2^m points in lanes are nets") {
  for (const std::uint32_t word : words(6, 50)) {
    const std::vector<carlo::Vec2> points = lane_points(256, word);
    for (std::uint32_t m = 0; m <= 8; ++m) {
      for (std::uint32_t columns = 0; columns <= m; ++columns) {
        std::vector<int> count(256);
        for (std::uint32_t i = 0; i < 256; ++i) {
          const auto column =
              static_cast<std::uint32_t>(std::ldexp(points[i].x, static_cast<int>(columns)));
          const auto row =
              static_cast<std::uint32_t>(std::ldexp(points[i].y, static_cast<int>(m - columns)));
          ++count[i >> m << m | row << columns | column];
        }
        CHECK(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
      }
    }
  }
}

// A gain g of n points, each draw's being at most n, is estimated with a standard error below
// sqrt(g n / draws) = .25 for g = 4, n = 64; the limits are 6 of them above 4 and above 2.2. Pairs
// that were the same net up to a shift would have gains of n: 16 and 64.
TEST_CASE(
    "No Walsh function of two dimension pairs has much more variance than with independent "
    "points") {
  constexpr std::uint64_t draws = 4000;
  for (const std::uint32_t n : {2u, 4u, 8u, 16u, 32u, 64u}) {
    const auto scalar =
        walsh::worst_gains(n, draws, [](std::uint64_t draw, std::uint32_t pair, std::uint32_t i) {
          carlo::SobolSampler sampler({.seed = draw, .index = i});
          sampler.seek(2 * pair);
          return sampler.next_2d();
        });
    INFO(n << " points, scalar: " << scalar.pair << ", " << scalar.product);
    CHECK(scalar.pair < 3.3);
    CHECK(scalar.product < 5.5);
    for (const bool one_vertex : {false, true}) {
      std::array<std::vector<carlo::Vec2>, 2> points;
      const auto lanes = walsh::worst_gains(
          n, draws, [&](std::uint64_t draw, std::uint32_t pair, std::uint32_t i) {
            if (i == 0) points[pair] = lane_points(64, words_of(draw, one_vertex)[pair]);
            return points[pair][i];
          });
      INFO(n << " points, lanes: " << lanes.pair << ", " << lanes.product);
      CHECK(lanes.pair < 3.3);
      CHECK(lanes.product < 5.5);
    }
  }
}

// Full Owen scrambling is steeper, but takes twice the instructions and does not reduce noise in
// paths.
TEST_CASE("The error of Sobol' points in lanes on a smooth integrand falls as 1 / n") {
  const double slope = std::log2(smooth_error(4096) / smooth_error(64)) / 6;
  INFO(slope);
  CHECK(slope < -.95);
}

}  // namespace renderer
#endif
