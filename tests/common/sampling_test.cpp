#include "random/rng.h"
#include "sampling/permutation.h"
#include "sampling/samplers.h"
#include "sampling/sobol.h"

#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace carlo;

/// Sobol's second coordinate by its textbook recurrence: direction numbers v_{k+1} = v_k ^ v_k / 2
/// (primitive polynomial x + 1, m_1 = 1).
std::uint32_t textbook_second(std::uint32_t index) {
  std::uint32_t v = 0x80000000, x = 0;
  for (; index != 0; index >>= 1, v ^= v >> 1) {
    if (index & 1) x ^= v;
  }
  return x;
}

TEST_CASE("The second Sobol' coordinate agrees with the textbook's direction numbers") {
  Rng rng(1);
  for (std::uint32_t i = 0; i < 5000; ++i)
    CHECK(sobol_second(i) == textbook_second(i));
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t index = rng.next_u32();
    CHECK(sobol_second(index) == textbook_second(index));
  }
}

/// True if 2^m points have one point in each elementary interval of volume 2^-m.
bool is_net(const std::vector<Vec2>& points, int m) {
  for (int k = 0; k <= m; ++k) {
    std::set<std::pair<int, int>> boxes;
    for (const Vec2 p : points) {
      boxes.emplace(static_cast<int>(std::ldexp(p.x, k)), static_cast<int>(std::ldexp(p.y, m - k)));
    }
    if (boxes.size() != points.size()) return false;
  }
  return true;
}

TEST_CASE("Every aligned block of shuffled, scrambled Sobol' points is a (0, m, 2)-net") {
  for (const int m : {1, 4, 8}) {
    for (std::uint32_t block = 0; block < 5; ++block) {
      std::vector<Vec2> points;
      const std::uint32_t n = 1u << m;
      for (std::uint32_t i = 0; i < n; ++i) {
        SobolSampler sampler({.seed = 3, .pixel = 17, .index = block * n + i, .spp = 1024});
        sampler.seek(5);
        points.push_back(sampler.next_2d());
      }
      CHECK(is_net(points, m));
    }
  }
}

TEST_CASE("Owen scrambling is uniform: each point is equally likely in each of 64 intervals") {
  // Chi-square over seeds, 64 cells with 1000 expected, 63 degrees of freedom: 63 + 5.5 sd is
  // beyond the alpha = 1e-6 quantile (127).
  std::vector<int> count(64);
  for (std::uint64_t seed = 0; seed < 64000; ++seed) {
    SobolSampler sampler({.seed = seed, .pixel = 5, .index = 3, .spp = 8});
    ++count[static_cast<std::size_t>(sampler.next_2d().y * 64)];
  }
  double chi2 = 0;
  for (const int c : count)
    chi2 += (c - 1000.0) * (c - 1000.0) / 1000.0;
  CHECK(chi2 <= 127);
}

TEST_CASE("permute() is a permutation for every size") {
  for (const std::uint32_t n : {1u, 2u, 3u, 7u, 12u, 13u, 16u, 100u, 1000u}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::set<std::uint32_t> images;
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = permute(i, n, mix(seed));
        CHECK(j < n);
        images.insert(j);
      }
      CHECK(images.size() == n);
    }
  }
}

/// The rank that permute() gives a seed, and the rank of the resulting permutation.
std::uint64_t rank_of_images(std::uint32_t n, std::uint64_t seed) {
  std::vector<std::uint32_t> images;
  for (std::uint32_t i = 0; i < n; ++i)
    images.push_back(permute(i, n, seed));
  std::uint64_t rank = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint64_t smaller = 0;
    for (std::uint32_t k = i + 1; k < n; ++k)
      smaller += images[k] < images[i];
    rank += smaller * factorial(n - 1 - i);
  }
  return rank;
}

TEST_CASE("permute() gives every permutation of up to 12 the same share of the seeds") {
  // By exact counting, without drawing: the seeds of rank r are those from ceil(r 2^64 / n!) up to
  // the next rank's, 2^64 / n! of them, give or take one. Its first and last seed must make the
  // permutation of rank r: tested for every r up to n = 8, and for 20000 of them above.
  __extension__ using Wide = unsigned __int128;
  for (std::uint32_t n = 2; n <= most_ranked; ++n) {
    const std::uint64_t count = factorial(n);
    const auto first = [&](std::uint64_t rank) {
      return static_cast<std::uint64_t>(((static_cast<Wide>(rank) << 64) + count - 1) / count);
    };
    const std::uint64_t step = n <= 8 ? 1 : count / 20000;
    for (std::uint64_t rank = 0; rank < count; rank += step) {
      REQUIRE(rank_of_images(n, first(rank)) == rank);
      REQUIRE(rank_of_images(n, rank + 1 < count ? first(rank + 1) - 1 : ~std::uint64_t{0}) ==
              rank);
    }
  }
}

TEST_CASE("permute() sends every pair of elements everywhere equally often") {
  // Chi-square of the images of two elements over 1e5 seeds, n (n - 1) cells. Its normal deviate is
  // beyond 5.5 with alpha <= 1e-6 for these degrees of freedom (Wilson and Hilferty).
  for (const std::uint32_t n : {3u, 4u, 5u, 13u, 16u, 36u}) {
    for (const auto& [a, b] : {std::pair{0u, 1u}, std::pair{0u, 2u}, std::pair{1u, n - 1}}) {
      std::vector<double> count(std::size_t{n} * n);
      constexpr int seeds = 100000;
      for (std::uint64_t seed = 0; seed < seeds; ++seed)
        count[permute(a, n, mix(seed)) * n + permute(b, n, mix(seed))] += 1;
      const double expected = seeds / static_cast<double>(n * (n - 1));
      double chi2 = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        CHECK(count[i * n + i] == 0);
        for (std::uint32_t k = 0; k < n; ++k)
          if (i != k)
            chi2 += (count[i * n + k] - expected) * (count[i * n + k] - expected) / expected;
      }
      const double freedom = n * (n - 1) - 1.0, w = 2 / (9 * freedom);
      INFO("n = " << n << ", elements " << a << " and " << b << ", chi2 " << chi2);
      CHECK((std::cbrt(chi2 / freedom) - (1 - w)) / std::sqrt(w) <= 5.5);
    }
  }
}

TEST_CASE("Pairs of dimensions are stratified independently") {
  // For n samples the cells of two dimension pairs make two permutations. How often samples 0 and 1
  // are in cells i, j of one and k, l of the other must be independent, by chi-square over 2e5
  // seeds.
  constexpr std::uint32_t n = 4;
  constexpr int seeds = 200000;
  std::vector<double> count(144);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    std::size_t cell = 0;
    for (const std::uint32_t dimension : {2u, 10u}) {
      std::array<std::size_t, 2> at{};
      for (std::uint32_t i = 0; i < 2; ++i) {
        StratifiedSampler sampler({.seed = seed, .pixel = 3, .index = i, .spp = n});
        sampler.seek(dimension);
        const Vec2 p = sampler.next_2d();
        at[i] = static_cast<std::size_t>(p.x * 2) + 2 * static_cast<std::size_t>(p.y * 2);
      }
      REQUIRE(at[0] != at[1]);
      cell = cell * 12 + at[0] * 3 + (at[1] > at[0] ? at[1] - 1 : at[1]);
    }
    count[cell] += 1;
  }
  double chi2 = 0;
  for (const double c : count)
    chi2 += (c - seeds / 144.0) * (c - seeds / 144.0) / (seeds / 144.0);
  CHECK(chi2 <= 240);  // 143 degrees of freedom: alpha = 1e-6
}

TEST_CASE("Stratified samples fall one into each stratum, and none is 1") {
  // Hard case 23: (i + u) / N in float leaves its stratum or reaches 1.
  constexpr std::uint32_t n = 1u << 12;
  std::set<int> strata, cells;
  for (std::uint32_t i = 0; i < n; ++i) {
    StratifiedSampler sampler({.seed = 1, .pixel = 2, .index = i, .spp = n});
    const Vec2 p = sampler.next_2d();
    const float x = sampler.next_1d();
    CHECK((p.x < 1 && p.y < 1 && x < 1));
    cells.insert(static_cast<int>(p.x * 64) * 64 + static_cast<int>(p.y * 64));
    strata.insert(static_cast<int>(x * static_cast<float>(n)));
  }
  CHECK(cells.size() == n);
  CHECK(strata.size() == n);
}

TEMPLATE_TEST_CASE("A sampler's coordinates are uniform and unbiased, and seek() repeats them", "",
                   IndependentSampler, StratifiedSampler, SobolSampler) {
  // The mean of x, y and x*y over independent seeds; n = 40000, |z| < 5.5: alpha = 4e-8 each.
  constexpr int n = 40000;
  double x = 0, y = 0, xy = 0;
  for (std::uint64_t seed = 0; seed < n; ++seed) {
    TestType sampler({.seed = seed, .pixel = 9, .index = 5, .spp = 12});
    sampler.seek(10);
    const Vec2 p = sampler.next_2d();
    x += p.x;
    y += p.y;
    xy += p.x * p.y;
    sampler.seek(10);
    CHECK(sampler.next_2d() == p);
  }
  const double sd = std::sqrt(1.0 / 12 / n), sd_xy = std::sqrt((1.0 / 9 - 1.0 / 16) / n);
  CHECK(std::abs(x / n - 0.5) <= 5.5 * sd);
  CHECK(std::abs(y / n - 0.5) <= 5.5 * sd);
  CHECK(std::abs(xy / n - 0.25) <= 5.5 * sd_xy);
}

/// The RMSE of the jittered or scrambled estimate of the integral of exp(-x^2 - y^2).
template <class Sampler>
double rmse(std::uint32_t n) {
  const double exact = 0.25 * 3.14159265358979 * std::pow(std::erf(1.0), 2);
  double sum2 = 0;
  constexpr int replicates = 200;
  for (std::uint64_t r = 0; r < replicates; ++r) {
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      Sampler sampler({.seed = r, .pixel = 0, .index = i, .spp = n});
      const Vec2 p = sampler.next_2d();
      sum += std::exp(-static_cast<double>(p.x) * p.x - static_cast<double>(p.y) * p.y);
    }
    sum2 += (sum / n - exact) * (sum / n - exact);
  }
  return std::sqrt(sum2 / replicates);
}

TEST_CASE("Stratified and scrambled points converge at their theoretical rates") {
  // Smooth integrand in 2D: N^-1/2 independent, N^-1 jittered, about N^-3/2 scrambled nets. An RMSE
  // from 200 replicates has a relative sd of 5 %, a slope over a factor 16 then one of .026.
  const auto slope = [](double coarse, double fine) {
    return std::log(fine / coarse) / std::log(16);
  };
  CHECK(std::abs(slope(rmse<IndependentSampler>(16), rmse<IndependentSampler>(256)) + 0.5) <= 0.15);
  CHECK(std::abs(slope(rmse<StratifiedSampler>(16), rmse<StratifiedSampler>(256)) + 1.0) <= 0.15);
  CHECK(slope(rmse<SobolSampler>(16), rmse<SobolSampler>(256)) <= -1.3);
}

TEMPLATE_TEST_CASE("Each of the 64 bits of a seed changes a sampler's coordinates", "",
                   IndependentSampler, StratifiedSampler, SobolSampler) {
  std::set<std::pair<float, float>> points;
  for (int bit = 0; bit <= 64; ++bit) {
    const std::uint64_t seed = bit < 64 ? 7 ^ std::uint64_t{1} << bit : 7;
    TestType sampler({.seed = seed, .pixel = 9, .index = 5, .spp = 16});
    const Vec2 p = sampler.next_2d();
    points.insert({p.x, p.y});
  }
  CHECK(points.size() == 65);
}

}  // namespace
