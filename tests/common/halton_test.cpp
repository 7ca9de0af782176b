#include "sampling/halton.h"

#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace carlo;

TEST_CASE("radical inverses mirror the digits at the point", "[halton]") {
  STATIC_REQUIRE(radical_inverse(2, 0) == 0);
  STATIC_REQUIRE(radical_inverse(2, 1) == 0.5);
  STATIC_REQUIRE(radical_inverse(2, 6) == 0.375);
  STATIC_REQUIRE(radical_inverse(3, 1) == 1.0 / 3);
  STATIC_REQUIRE(radical_inverse(3, 7) == 5.0 / 9);  // 21 in base 3 becomes 0.12
  STATIC_REQUIRE(radical_inverse(10, 1234) == 0.4321);
  STATIC_REQUIRE(halton(5, 2) == 1.0 / 25);
}

TEST_CASE("the largest indices give the largest fractions below 1", "[halton]") {
  CHECK(radical_inverse(2, (std::uint64_t{1} << 53) - 1) == 1 - 0x1p-53);
  for (const std::uint32_t base : halton_bases) {
    std::uint64_t power = base;
    while (power * base < (std::uint64_t{1} << 32))
      power *= base;
    const double exact = 1 - 1 / static_cast<double>(power);
    CHECK(std::fabs(radical_inverse(base, power - 1) - exact) <= 0x1p-53);
    CHECK(radical_inverse(base, power - 1) < 1);
  }
}

// Any b^k consecutive points have one in each of the b^k strata.
TEST_CASE("consecutive points of one coordinate are stratified", "[halton]") {
  for (std::size_t dimension = 0; dimension < 6; ++dimension) {
    const std::uint32_t base = halton_bases[dimension];
    std::uint64_t strata = base;
    while (strata * base <= 4096)
      strata *= base;
    const std::uint64_t first = 3 * strata;  // aligned: the strata are hit exactly
    std::vector<int> hits(strata, 0);
    for (std::uint64_t i = first; i < first + strata; ++i) {
      const double at = halton(i, dimension) * static_cast<double>(strata);
      ++hits[static_cast<std::size_t>(at + 1e-6)];
    }
    for (const int hit : hits)
      REQUIRE(hit == 1);
  }
}

// By the Chinese remainder theorem 2^a 3^b consecutive points put one into each cell of the grid.
TEST_CASE("the first two coordinates together are stratified", "[halton]") {
  constexpr std::size_t columns = 16, rows = 27;
  for (const std::uint64_t first : {0U, 1000U}) {
    std::array<int, columns * rows> hits{};
    for (std::uint64_t i = first; i < first + columns * rows; ++i) {
      const auto column = static_cast<std::size_t>(halton(i, 0) * columns + 1e-6);
      const auto row = static_cast<std::size_t>(halton(i, 1) * rows + 1e-6);
      ++hits[row * columns + column];
    }
    for (const int hit : hits)
      REQUIRE(hit == 1);
  }
}

TEST_CASE("shifted values stay in the unit interval", "[halton]") {
  const double last = 1 - 0x1p-53;
  CHECK(rotated(0, 0) == 0);
  CHECK(rotated(last, 0) == last);
  CHECK(rotated(0, last) == last);
  CHECK(rotated(last, last) == 1 - 0x1p-52);
  CHECK(rotated(0.5, 0.5) == 0);
  CHECK(rotated(0x1p-60, last) < 1);
  CHECK(rotated(0x1p-60, last) >= 0);
  Rng rng(1);
  for (int i = 0; i < 100'000; ++i) {
    const double x = rng.uniform(), shift = rng.uniform();
    const double moved = rotated(x, shift);
    REQUIRE((moved >= 0 && moved < 1));
    // On the circle it lies `shift` further.
    const double around = moved - x - shift;
    REQUIRE(std::fabs(around - std::round(around)) <= 0x1p-52);
  }
}
