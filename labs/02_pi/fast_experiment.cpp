#include "course/report/format.h"
#include "experiments.h"
#include "pi.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <random>

// Darts per second, and what a counter of type float does with many of them.

namespace lab02 {
namespace {

using Thrower = std::function<std::int64_t(std::int64_t n)>;

/// The loop that most people write first, with the library's generator.
std::int64_t plain_loop(std::mt19937& generator, std::int64_t n) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::int64_t hits = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = uniform(generator);
    const double y = uniform(generator);
    if (x * x + y * y < 1) ++hits;
  }
  return hits;
}

/// One way to throw darts, with the best time so far: disturbances only make a loop slower.
struct Way {
  std::string name;
  Thrower throws;
  double seconds = 1e9;
  std::int64_t hits = 0;
};

/// The ways take turns, so that a slow moment of the machine affects all of them.
void time_all(std::vector<Way>& ways, std::int64_t n, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (Way& way : ways) {
      const carlo::WallClock clock;
      way.hits = way.throws(n);
      way.seconds = std::min(way.seconds, clock.seconds());
    }
  }
}

void speed_table(Notebook& notebook) {
  const std::int64_t n = notebook.options().quick ? 500'000 : 4'000'000;
  std::mt19937 mersenne(static_cast<std::mt19937::result_type>(notebook.rng().next_u32()));
  carlo::Rng rng = notebook.rng();
  const std::uint64_t key = notebook.rng().next_u64();
  std::vector<Way> ways = {{"std::mt19937, uniform_real_distribution",
                            [&](std::int64_t m) { return plain_loop(mersenne, m); }}};
  notebook.attempt([&] {
    (void)throw_darts(1, rng);
    ways.push_back({"throw_darts", [&](std::int64_t m) { return throw_darts(m, rng).hits; }});
  });
  notebook.attempt([&] {
    (void)count_hits(key, 0, 1);
    ways.push_back({"count_hits", [key](std::int64_t m) { return count_hits(key, 0, m); }});
  });
  time_all(ways, n, 7);
  carlo::Table table(
      {"one thread", "estimate", "time a dart", "darts a second", "against the first"},
      {"way", "estimate", "seconds", "darts_per_second", "ratio"});
  const auto count = static_cast<double>(n);
  for (const Way& way : ways) {
    const double rate = count / way.seconds;
    const double ratio = ways.front().seconds / way.seconds;
    table.add_row({way.name, 4 * static_cast<double>(way.hits) / count,
                   carlo::seconds_cell(way.seconds / count),
                   carlo::Cell(fmt::format("{:.0f} million", rate / 1e6), rate),
                   carlo::Cell(fmt::format("{:.2f} ×", ratio), ratio)});
  }
  notebook.table("speed", table,
                 fmt::format("{} darts, the best of 7 runs each", carlo::count_text(n)));
}

/// The hits so far, in both kinds of counter. The darts are those of Lab 2.5, tested one by one.
struct Counters {
  std::int64_t whole = 0;
  float in_float = 0;

  void count(std::uint64_t key, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const std::uint64_t dart = dart_word(key, i / 2) >> (i % 2 == 0 ? 0 : 32);
      const double x = (static_cast<double>(dart & 0xFFFF) + 0.5) / 65536;
      const double y = (static_cast<double>(dart >> 16 & 0xFFFF) + 0.5) / 65536;
      if (x * x + y * y < 1) {
        ++whole;
        in_float += 1.0f;
      }
    }
  }
};

void float_counter(Notebook& notebook) {
  carlo::Table table(
      {"N", "counted in float", "π by it", "π by whole numbers", "error of the first", "time"},
      {"points", "float_hits", "float_estimate", "estimate", "float_error", "seconds"});
  carlo::Chart chart{"Counting in float",
                     "",
                     {"darts N", carlo::Unit::count},
                     {"estimate of π", carlo::Unit::number, carlo::Scale::linear},
                     {{"float counter", {}}, {"whole numbers", {}}}};
  const std::uint64_t key = notebook.rng().next_u64();
  Counters counters;
  std::int64_t thrown = 0;
  const carlo::WallClock clock;
  for (const std::int64_t n : {1'000'000, 5'000'000, 10'000'000, 20'000'000, 22'000'000, 25'000'000,
                               30'000'000, 40'000'000, 50'000'000}) {
    counters.count(key, thrown, n);
    thrown = n;
    const auto count = static_cast<double>(n);
    const double by_float = 4 * static_cast<double>(counters.in_float) / count;
    const double by_whole = 4 * static_cast<double>(counters.whole) / count;
    table.add_row({n, static_cast<std::int64_t>(counters.in_float), by_float, by_whole,
                   by_float - 3.14159265358979, carlo::seconds_cell(clock.seconds())});
    chart.series[0].points.push_back({count, by_float});
    chart.series[1].points.push_back({count, by_whole});
  }
  notebook.say(
      "More darts, and π falls: at 16 777 216 = 2^24 the next float is 2 away, and adding 1 rounds "
      "back. The counter stands still while N grows. No warning, no NaN; an image summed up in "
      "float darkens in the same way.");
  notebook.table("float_counter", table, "The same darts, counted in float and in whole numbers");
  notebook.charts({chart});
}

}  // namespace

void fast_experiment(Notebook& notebook) {
  notebook.begin("Darts a second");
  speed_table(notebook);
  notebook.progress(1, 2);
  notebook.begin("π falls as N grows");
  float_counter(notebook);
}

}  // namespace lab02
