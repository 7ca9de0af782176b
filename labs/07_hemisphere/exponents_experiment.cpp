#include "course/report/stopwatch.h"
#include "experiments.h"
#include "numeric/robust.h"

#include <cmath>

// An open sky by lobes around the normal: n = 0 is uniform, n = 1 cosine-weighted, and beyond?

namespace lab07 {
namespace {

/// The standard deviation of one direction's cos/p, relative to the irradiance pi: infinite from n
/// = 3 on.
double relative_deviation(double n) {
  return std::sqrt(4 / ((n + 1) * (3 - n)) - 1);
}

struct AngleFound {
  double mean = 0, deviation = 0, largest = 0, seconds = 0;
};

/// One direction at a time, so that single contributions can be examined.
AngleFound measure(float n, std::int64_t count, carlo::Rng rng) {
  const Sampling sampling{Technique::lobe, {0, 0, 1}, n};
  const Radiance sky = [](Vec3) { return 1.0f; };
  AngleFound found;
  double squares = 0;
  const carlo::Stopwatch watch;
  for (std::int64_t i = 0; i < count; ++i) {
    const double y = irradiance(sky, {0, 0, 1}, sampling, 1, rng) / carlo::pi;
    found.mean += y;
    squares += (y - 1) * (y - 1);
    found.largest = std::max(found.largest, y);
  }
  const double spent = watch.seconds();
  const auto total = static_cast<double>(count);
  found.mean /= total;
  found.deviation = std::sqrt(squares / total);
  found.seconds = spent / total;
  return found;
}

}  // namespace

void exponents_experiment(Notebook& notebook) {
  notebook.begin("The right density, and one too thin");
  notebook.attempt([&] {
    carlo::Table table({"n", "directions", "estimate / π", "deviation", "theory", "largest share",
                        "time a direction"},
                       {"n", "count", "estimate", "deviation", "theory", "largest", "seconds"});
    carlo::Series measured{"measured", {}}, theory{"theory", {}};
    const std::int64_t count = notebook.options().n;
    int done = 0;
    for (const double n : {0.0, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0}) {
      notebook.progress(done++, 11);
      const AngleFound found = measure(static_cast<float>(n), count, notebook.rng());
      const double exact = n < 3 ? relative_deviation(n) : INFINITY;
      table.add_row({n, count, found.mean, found.deviation,
                     n < 3 ? carlo::Cell(exact) : carlo::Cell("infinite"),
                     found.largest / (found.mean * static_cast<double>(count)),
                     carlo::seconds_cell(found.seconds)});
      measured.points.push_back({n, found.deviation});
    }
    for (int i = 0; i <= 58; ++i)
      theory.points.push_back({0.05 * i, relative_deviation(0.05 * i)});
    notebook.say(
        "The irradiance under an open sky, from lobes that stand upright: n = 0 is the uniform "
        "density, n = 1 the cosine-weighted one, proportional to the integrand, with no variance "
        "at all. Larger n thin out the horizon. There cos/p grows like cos^(1-n); its square has "
        "an infinite mean from n = 3 on. A measured deviation is then no more than the largest "
        "contribution so far, and the estimates fall short without showing it.");
    notebook.numbers("exponents", table,
                     "One direction's contribution, relative to the irradiance");
    notebook.charts(
        {carlo::Chart{"Relative standard deviation of one direction",
                      "an open sky, by a lobe around the normal",
                      {"n", carlo::Unit::number, carlo::Scale::linear},
                      {"standard deviation / mean", carlo::Unit::number, carlo::Scale::linear},
                      {measured, theory}}});
  });
}

}  // namespace lab07
