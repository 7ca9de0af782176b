#include "experiments.h"

#include <fmt/core.h>

#include <algorithm>

// Strata in float. The naive forms are the subject of the experiment, not an example.

namespace lab04 {
namespace {

using Place = float (*)(std::int32_t i, std::int32_t n, float u);

// slide: naive
float naive(std::int32_t i, std::int32_t n, float u) {
  return (static_cast<float>(i) + u) / static_cast<float>(n);
}

float clamped(std::int32_t i, std::int32_t n, float u) {
  return std::min(naive(i, n, u), 0x1.fffffep-1f);
}
// end slide

struct Method {
  std::string name;
  Place place;
};

struct Astray {
  double last_at_one = 0;  ///< fraction of the last stratum's points that are 1
  double outside = 0;      ///< fraction of all points that are outside their stratum
};

Astray count(Place place, std::int32_t n, int draws, carlo::Rng& rng) {
  int ones = 0, outside = 0;
  for (int k = 0; k < draws; ++k) {
    ones += place(n - 1, n, rng.uniform_float()) >= 1 ? 1 : 0;
    const auto i = static_cast<std::int32_t>(rng.uniform() * n);
    const double x = place(i, n, rng.uniform_float());
    outside += x * n >= i && x * n < i + 1.0 ? 0 : 1;
  }
  return {static_cast<double>(ones) / draws, static_cast<double>(outside) / draws};
}

carlo::Cell percent(double share) {
  return {fmt::format("{:.2f} %", 100 * share), share};
}

}  // namespace

void float_experiment(Notebook& notebook) {
  notebook.begin("Strata in float");
  std::vector<Method> methods = {{"(i + u)/n in float", naive},
                                 {"the same, kept below 1", clamped}};
  notebook.attempt([&] {
    (void)place_in_stratum(0, 1, 0);
    methods.push_back({"your place_in_stratum", place_in_stratum});
  });
  carlo::Table table({"method", "strata", "last stratum at 1", "not in their stratum", "time"},
                     {"method", "strata", "last_at_one", "outside", "seconds"});
  const int draws = notebook.options().quick ? 50'000 : 400'000;
  for (const std::int32_t n : {1 << 10, 1000, 1 << 16, 1 << 20}) {
    for (const Method& method : methods) {
      carlo::Rng rng = notebook.rng();
      const Astray astray = count(method.place, n, draws, rng);
      constexpr int batch = 4096;
      const Measurement timed = carlo::time_rule(batch, 0, [&] {
        double sum = 0;
        for (int k = 0; k < batch; ++k)
          sum += static_cast<double>(method.place(k % n, n, rng.uniform_float()));
        return sum;
      });
      table.add_row({method.name, static_cast<std::int64_t>(n), percent(astray.last_at_one),
                     percent(astray.outside), carlo::seconds_cell(timed.seconds / batch)});
    }
  }
  notebook.say(
      "Renderers place their strata in float. Above 1/2 floats are 2^-24 apart: with 2^20 strata a "
      "stratum holds sixteen of them, and i + u keeps four bits of u. Some points are rounded into "
      "the next stratum, and the last stratum's to 1, which is outside of [0, 1). Keeping the "
      "result below 1 mends what crashes and leaves the rest.");
  notebook.table("float", table,
                 "Share of points that leave their stratum; time of one with its random number");
}

}  // namespace lab04
