// The given spectral test against published figures and your exercise's algorithm.

#include "spectral.h"

#include "rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>

using namespace lab03;

namespace {

constexpr std::uint64_t most = std::uint64_t{1} << 32;

void check_is_dual(const DualVector& v, std::uint64_t a, std::uint64_t c) {
  Wide sum = 0, power = 1, squared = 0;
  for (const std::int64_t s : v.s) {
    sum += s * power;
    power = power * static_cast<Wide>(a) % static_cast<Wide>(c);
    squared += static_cast<Wide>(s) * s;
  }
  CHECK(sum % static_cast<Wide>(c) == 0);
  CHECK(squared == static_cast<Wide>(v.squared));
  CHECK(v.squared > 0);
}

}  // namespace

TEST_CASE("the lecture's LCG, RANDU and MINSTD have their known spectral figures") {
  const auto length = [](std::uint64_t a, std::uint64_t c, int d) {
    const DualVector v = shortest_dual_vector(a, c, d);
    check_is_dual(v, a, c);
    return std::lround(v.length());
  };
  CHECK(length(1664525, most, 2) == 70277);
  CHECK(length(1664525, most, 3) == 1524);
  CHECK(length(1664525, most, 4) == 252);
  CHECK(length(16807, 2147483647, 3) == 639);
  const DualVector randu = shortest_dual_vector(65539, std::uint64_t{1} << 31, 3);
  check_is_dual(randu, 65539, std::uint64_t{1} << 31);
  CHECK(randu.squared == 118);  // (9, -6, 1)
  CHECK(randu.planes(false) == 15);
  CHECK(shortest_dual_vector(1664525, most, 3).planes(true) == 2280);
}

TEST_CASE("the lines of RANDU's pairs are 1/23171.9 apart, counted from its own numbers") {
  // Its states are odd, so that 16387 x + 16383 x' is the same modulo 2^31 for every pair, and the
  // spacing of its lines follows from 2^30, not 2^31.
  constexpr std::uint64_t c = std::uint64_t{1} << 31;
  CHECK(spectral_2d(65539, c / 2) == 16387u * 16387u + 16383u * 16383u);
  std::uint64_t x = 12345;
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t next = 65539 * x % c;
    REQUIRE((16387 * x + 16383 * next) % c == c / 2);
    x = next;
  }
}

TEST_CASE("in two dimensions trying all vectors and Gauss's reduction agree") {
  std::uint64_t x = 99;
  for (int i = 0; i < 50; ++i) {
    x = x * 6364136223846793005 + 1442695040888963407;
    const std::uint64_t c = 2 + (x >> 50) * (x >> 50) % (most - 2), a = 1 + (x >> 20) % (c - 1);
    INFO(a << " mod " << c);
    CHECK(shortest_dual_vector(a, c, 2).squared == spectral_2d(a, c));
  }
  CHECK(shortest_dual_vector(1, most, 2).squared == 2);
  CHECK(shortest_dual_vector(1, 2, 3).squared == 2);
  CHECK_THROWS_AS(shortest_dual_vector(5, 4, 2), carlo::Error);
}
