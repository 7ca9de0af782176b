#include "experiments.h"
#include "random/rng.h"
#include "rng.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <functional>
#include <vector>

// Floats that reach 1, and integers that are favoured. The naive forms below are the subject of the
// experiment, not an example.

namespace lab03 {
namespace {

struct FloatMethod {
  std::string name;
  std::function<float(std::uint32_t)> convert;
};

/// The number of all 2^32 words that become 1: they are the largest ones, so counting stops at the
/// first that does not.
std::int64_t words_that_reach_one(const FloatMethod& method) {
  std::int64_t count = 0;
  for (std::uint32_t word = 0xFFFFFFFF; word > 0xFFFF0000 && method.convert(word) >= 1; --word)
    ++count;
  return count;
}

double seconds_a_float(const FloatMethod& method, std::int64_t n) {
  volatile float sink = 0;
  float sum = 0;
  const carlo::WallClock clock;
  for (std::int64_t i = 0; i < n; ++i)
    sum += method.convert(static_cast<std::uint32_t>(i) * 2654435769u);
  sink = sum;
  (void)sink;
  return clock.seconds() / static_cast<double>(n);
}

void floats(Notebook& notebook) {
  std::vector<FloatMethod> methods = {
      {"word / (float)UINT32_MAX",
       [](std::uint32_t w) { return static_cast<float>(w) / static_cast<float>(UINT32_MAX); }},
      {"word · 2^-32 in float", [](std::uint32_t w) { return static_cast<float>(w) * 0x1p-32f; }}};
  notebook.attempt([&] {
    (void)unit_float(0);
    methods.push_back({"your unit_float", unit_float});
  });
  carlo::Table table({"method", "words of 2^32 that give 1", "time"},
                     {"method", "ones", "seconds"});
  for (const FloatMethod& method : methods)
    table.add_row({method.name, words_that_reach_one(method),
                   carlo::seconds_cell(seconds_a_float(method, 1 << 22))});
  notebook.say(
      "A float holds 24 binary digits. A word of 32 is rounded when it becomes one, and the "
      "largest words are rounded up to 2^32: one draw in 33 million is then exactly 1, which a "
      "logarithm, a table or a stratum does not expect.");
  notebook.table("floats", table, "Floats in [0, 1)");
}

struct IntegerMethod {
  std::string name;
  std::function<std::int64_t(std::uint64_t values, carlo::Rng& rng)> draw;
};

/// The shares of the low third, and of the values that are multiples of 3.
struct Shares {
  double low_third = 0, multiples = 0, beyond = 0, seconds = 0;
};

Shares shares(const IntegerMethod& method, std::uint64_t values, std::int64_t n, carlo::Rng rng) {
  std::int64_t low = 0, multiples = 0, beyond = 0;
  const carlo::WallClock clock;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t x = method.draw(values, rng);
    if (3 * static_cast<std::uint64_t>(x) < values) ++low;
    if (x % 3 == 0) ++multiples;
    if (static_cast<std::uint64_t>(x) >= values) ++beyond;
  }
  const auto count = static_cast<double>(n);
  return {static_cast<double>(low) / count, static_cast<double>(multiples) / count,
          static_cast<double>(beyond) / count, clock.seconds() / count};
}

void integers(Notebook& notebook) {
  const auto real = [](std::uint64_t values) { return 0x1p32 / static_cast<double>(values); };
  std::vector<IntegerMethod> methods = {
      {"modulo", [](std::uint64_t m,
                    carlo::Rng& rng) { return static_cast<std::int64_t>(rng.next_u32() % m); }},
      {"division, real",
       [real](std::uint64_t m, carlo::Rng& rng) {
         return static_cast<std::int64_t>(rng.next_u32() / real(m));
       }},
      {"division, whole", [](std::uint64_t m, carlo::Rng& rng) {
         return static_cast<std::int64_t>(rng.next_u32() / ((std::uint64_t{1} << 32) / m));
       }}};
  notebook.attempt([&] {
    (void)integer_between(0, 0, [] { return 1u; });
    methods.push_back(
        {"your integer_between", [](std::uint64_t m, carlo::Rng& rng) {
           const auto u = std::int64_t{INT32_MIN};
           const auto v = static_cast<std::int32_t>(u + static_cast<std::int64_t>(m) - 1);
           return integer_between(INT32_MIN, v, [&rng] { return rng.next_u32(); }) - u;
         }});
  });
  const std::int64_t n = std::min<std::int64_t>(notebook.options().n, 1 << 20);
  carlo::Table table({"method", "values", "low third", "multiples of 3", "out of range", "time"},
                     {"method", "values", "low_third", "multiples", "out_of_range", "seconds"});
  for (const std::uint64_t values :
       {std::uint64_t{6}, std::uint64_t{999'999'999}, std::uint64_t{3'221'225'472}}) {
    for (const IntegerMethod& method : methods) {
      const Shares s = shares(method, values, n, notebook.rng());
      const auto percent = [](double x) {
        return carlo::Cell(fmt::format("{:.1f} %", 100 * x), x);
      };
      table.add_row({method.name, static_cast<std::int64_t>(values), percent(s.low_third),
                     percent(s.multiples), percent(s.beyond), carlo::seconds_cell(s.seconds)});
    }
  }
  notebook.say(
      "Whole numbers from a range of 6, of 10^9 - 1 and of 3 · 2^30. A third of the values lies in "
      "the low third, and a third are multiples of 3, so both shares should be 33.3 %. Division "
      "spreads the surplus where modulo heaps it up; neither makes it go away.");
  notebook.table("integers", table, "Who is favoured");
}

}  // namespace

void conversions_experiment(Notebook& notebook) {
  notebook.begin("Floats and whole numbers");
  floats(notebook);
  integers(notebook);
}

}  // namespace lab03
