#include "course/report/stopwatch.h"
#include "experiments.h"
#include "numeric/robust.h"

#include <fmt/core.h>

#include <cmath>

// The part of a lobe that falls below the horizon, at the angles where it matters.

namespace lab07 {
namespace {

/// The part of the lobe below the horizon, in closed form for whole n: the integral over half a
/// great circle, by recursion.
double part_below(int n, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  double sum = 0;
  double w = n % 2 == 0 ? 1 : carlo::pi / 2;  // the integral of sin^j over a quarter turn
  for (int j = n % 2 == 0 ? 1 : 0; j <= n - 1; j += 2) {
    sum += std::pow(s, j) * w;
    w *= (j + 1.0) / (j + 2.0);
  }
  return ((n % 2 == 0 ? theta : carlo::pi / 2) - c * sum) / carlo::pi;
}

}  // namespace

void mirror_experiment(Notebook& notebook) {
  notebook.begin("Below the horizon");
  notebook.attempt([&] {
    carlo::Table table(
        {"n", "angle of wo", "directions", "lost, found", "lost, exact", "z", "time a direction"},
        {"n", "degrees", "count", "found", "exact", "z", "seconds"});
    carlo::Chart chart{"The part of the lobe below the horizon",
                       "measured, from directions of Lab 7.6",
                       {"angle of wo in degrees", carlo::Unit::degrees, carlo::Scale::linear},
                       {"part", carlo::Unit::number, carlo::Scale::linear},
                       {}};
    const std::int64_t count = notebook.options().n / 4;
    for (const int n : {1, 10, 100, 1000}) {
      carlo::Series series{fmt::format("n = {}", n), {}};
      for (const double degrees : {0.0, 30.0, 60.0, 70.0, 80.0, 85.0, 89.0}) {
        const double theta = degrees * carlo::pi / 180;
        const Vec3 wo(std::sin(theta), 0, std::cos(theta));
        carlo::Rng rng = notebook.rng();
        std::int64_t below = 0;
        const carlo::Stopwatch watch;
        for (std::int64_t i = 0; i < count; ++i) {
          const float x = rng.uniform_float();
          const float y = rng.uniform_float();
          below += sample_mirror_lobe({x, y}, wo, static_cast<float>(n)).z < 0 ? 1 : 0;
        }
        const double spent = watch.seconds();
        const double total = static_cast<double>(count);
        const double found = static_cast<double>(below) / total, exact = part_below(n, theta);
        const double sd = std::sqrt(std::max(exact * (1 - exact), 1e-12) / total);
        series.points.push_back({degrees, found});
        if (exact * total < 10) continue;  // too few to be meaningful
        table.add_row({n, degrees, count, found, exact, (found - exact) / sd,
                       carlo::seconds_cell(spent / total)});
      }
      chart.series.push_back(std::move(series));
    }
    notebook.say(
        "The lobe surrounds the mirror direction, regardless of the surface. At grazing angles a "
        "good part of it points into the floor. Those directions are drawn and count, but "
        "contribute nothing: the light is absorbed. Drawing again until one is above would "
        "brighten every edge.");
    notebook.numbers("below", table, "The part of the lobe below the horizon");
    notebook.charts({chart});
  });
}

}  // namespace lab07
