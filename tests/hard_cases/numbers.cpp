#include "hard_case.h"
#include "image/film.h"
#include "integration.h"
#include "inversion_rejection.h"
#include "random/rng.h"
#include "render/integrator.h"
#include "rng.h"
#include "sampling/samplers.h"
#include "stratification.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace hard_cases {
namespace {

HardCase word_to_float() {
  int naive = 0, ours = 0;
  for (std::uint64_t word = (std::uint64_t{1} << 32) - 4096; word < std::uint64_t{1} << 32;
       ++word) {
    const auto x = static_cast<std::uint32_t>(word);
    naive += static_cast<float>(x) * 0x1p-32f >= 1 ? 1 : 0;
    ours += carlo::to_float(x) >= 1 ? 1 : 0;
  }
  return {1,
          "words that become the float 1",
          fmt::format("{} of 2^32", naive),
          fmt::format("{}", ours),
          "0",
          ours == 0};
}

HardCase nan_guard() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  carlo::Counts counts;
  carlo::BlockSum sum;
  sum.add({nan, 0, 0}, counts);
  sum.add({1, 1, 1}, counts);
  sum.add({-1, 0, 0}, counts);
  const double mean = sum.mean(1)[0];
  return {3,
          "a NaN and a negative sample",
          fmt::format("max(0, NaN) = {:g}", std::max(0.0f, nan)),
          fmt::format("{} counted, sum {:g}", counts.bad, mean),
          "2 counted, sum 1",
          counts.bad == 2 && mean == 1};
}

HardCase many_ones() {
  constexpr int n = 30'000'000;
  float naive = 0;
  carlo::Counts counts;
  carlo::BlockSum sum;
  for (int i = 0; i < n; ++i) {
    naive += 1;
    sum.add({1, 1, 1}, counts);
  }
  return {4,
          "3e7 ones, added",
          fmt::format("{:.0f} in float", naive),
          fmt::format("mean {:.17g}", sum.mean(n)[0]),
          "mean 1",
          sum.mean(n)[0] == 1};
}

HardCase variance() {
  carlo::Rng rng(5);
  lab01::Moments moments;
  double sum = 0, squares = 0;
  constexpr int n = 1'000'000;
  for (int i = 0; i < n; ++i) {
    const double x = 1e8 + std::sqrt(12.0) * (rng.uniform() - 0.5);
    moments.add(x);
    sum += x;
    squares += x * x;
  }
  const double naive = (squares - sum * sum / n) / (n - 1);
  return {5,
          "variance 1 around a mean of 1e8",
          fmt::format("{:.4g}", naive),
          fmt::format("{:.5f}", moments.variance()),
          "1 within .01",
          std::abs(moments.variance() - 1) <= 0.01};
}

HardCase strata() {
  constexpr std::int32_t n = 1 << 20;
  int naive = 0, ours = 0, last = 0;
  carlo::Rng rng(23);
  constexpr int count = 1'000'000;
  for (int i = 0; i < count; ++i) {
    const auto stratum = static_cast<std::int32_t>(rng.next_u32() % n);
    const float u = rng.uniform_float();
    const auto astray = [&](float x) {
      return std::floor(static_cast<double>(x) * n) == stratum ? 0 : 1;
    };
    naive += astray((static_cast<float>(stratum) + u) / n);
    ours += astray(lab04::place_in_stratum(stratum, n, u));
    last += lab04::place_in_stratum(n - 1, n, u) < 1 ? 0 : 1;
  }
  return {23,
          "2^20 strata, numbers in another one",
          fmt::format("{:.1f} %", 100.0 * naive / count),
          fmt::format("{} of {}, {} reach 1", ours, count, last),
          "0, 0 reach 1",
          ours == 0 && last == 0};
}

HardCase float_cdf() {
  constexpr std::size_t n = 10'000'000;
  float naive = 0;
  for (std::size_t i = 0; i < n; ++i)
    naive += 1.0f / static_cast<float>(n);
  const std::vector<double> weights(n, 0.1);
  const lab05::Discrete table(weights);
  const auto last = table.sample(std::nextafter(1.0, 0.0)).index;
  const double error = std::abs(table.probability(n / 2) * static_cast<double>(n) - 1);
  return {24,
          "a CDF of 1e7 equal bins",
          fmt::format("ends at {:.4f}", static_cast<double>(naive)),
          fmt::format("last drawn, {:.1e} off", error),
          "last drawn, 1e-8",
          last == n - 1 && error <= 1e-8};
}

HardCase seeds() {
  double naive = 0, ours = 0;
  constexpr int n = 100'000;
  for (int seed = 1; seed <= n; ++seed) {
    std::int64_t state = seed;
    const auto minstd = [&] {
      state = state * 16807 % 2147483647;
      return static_cast<double>(state) / 2147483647.0;
    };
    const double x = minstd(), y = minstd();
    naive += x * x + y * y < 1 ? 4.0 / n : 0;
    carlo::Rng rng(static_cast<std::uint64_t>(seed));
    const double u = rng.uniform(), v = rng.uniform();
    ours += u * u + v * v < 1 ? 4.0 / n : 0;
  }
  return {25,
          "pi from the first dart of 1e5 seeds",
          fmt::format("{:.4f} (minstd)", naive),
          fmt::format("{:.4f}", ours),
          "3.1416 +- .026",
          std::abs(ours - 3.14159265) <= 5 * 0.0052};
}

HardCase modulo() {
  // 3 * 2^30 values: the range [-2^31, 2^30).
  carlo::Rng rng(26);
  constexpr std::int32_t low = -2147483647 - 1, high = (1 << 30) - 1;
  constexpr double third = 1 << 30;
  double naive = 0, ours = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    naive += rng.next_u32() % 3221225472U < (1U << 30) ? 1.0 / n : 0;
    const std::int32_t x = lab03::integer_between(low, high, [&] { return rng.next_u32(); });
    ours += static_cast<double>(x) - low < third ? 1.0 / n : 0;
  }
  return {26,
          "share of the lowest third of 3 * 2^30",
          fmt::format("{:.3f} (modulo)", naive),
          fmt::format("{:.3f}", ours),
          ".333 +- .0075",
          std::abs(ours - 1.0 / 3) <= 5 * 0.0015};
}

HardCase argument_order() {
  carlo::IndependentSampler pair({31, 0, 0, 1}), single({31, 0, 0, 1});
  const carlo::Vec2 u = pair.next_2d();
  const float first = single.next_1d();
  const float second = single.next_1d();
  return {31,
          "two numbers in one expression",
          "order unspecified",
          u.x == first && u.y == second ? "in order" : "out of order",
          "in order",
          u.x == first && u.y == second};
}

HardCase order_of_sums() {
  carlo::Rng rng(33);
  std::vector<float> values(100'000);
  for (float& v : values)
    v = rng.uniform_float() * std::exp2(20 * rng.uniform_float());
  std::vector<float> backwards(values.rbegin(), values.rend());
  const double naive =
      static_cast<double>(std::accumulate(values.begin(), values.end(), 0.0f)) -
      static_cast<double>(std::accumulate(backwards.begin(), backwards.end(), 0.0f));
  carlo::Film there(1, 1, 1), back(1, 1, 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    there.add_block(0, 0, {static_cast<double>(values[i]), 0, 0});
    back.add_block(0, 0, {static_cast<double>(backwards[i]), 0, 0});
  }
  const double ours = there.mean(0, 0, 0) - back.mean(0, 0, 0);
  return {33,
          "a sum from front and from back",
          fmt::format("{:.3g} apart (float)", naive),
          fmt::format("{:g} apart", ours),
          "0",
          ours == 0};
}

}  // namespace

std::vector<HardCase> number_cases() {
  return {word_to_float(), nan_guard(), many_ones(), variance(),       strata(),
          float_cdf(),     seeds(),     modulo(),    argument_order(), order_of_sums()};
}

}  // namespace hard_cases
