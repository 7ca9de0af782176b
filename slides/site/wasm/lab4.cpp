// Lab 4: strata over an integrand, and boxes that recursive stratification splits.

#include "call.h"
#include "point_sets.h"

namespace site {
namespace {

using namespace lab04;

lab04::Integrand integrand(std::size_t which) {
  return which == 0 ? bell() : which == 1 ? darts() : peak();
}

/// set, n, seed: the points, as x, y pairs.
Numbers points(const Arguments& given) {
  carlo::Rng rng = given.rng(2, 1);
  Numbers xy;
  for (const Point& p : all_point_sets().at(given.index(0)).make(given.whole(1), rng))
    xy.insert(xy.end(), {p.x, p.y});
  return xy;
}

/// integrand, cells per side: its values at the cells' centres, from the top row down; divided by
/// the largest.
Numbers values(const Arguments& given) {
  const lab04::Integrand g = integrand(given.index(0));
  const std::int64_t side = given.whole(1);
  Numbers found;
  for (std::int64_t row = 0; row < side; ++row) {
    const double y = 1 - (static_cast<double>(row) + 0.5) / given[1];
    for (std::int64_t column = 0; column < side; ++column)
      found.push_back(g.f((static_cast<double>(column) + 0.5) / given[1], y));
  }
  return found;
}

/// set, integrand, n, runs, seed: the RMS error of the average over the points.
Numbers set_error(const Arguments& given) {
  const PointSet set = all_point_sets().at(given.index(0));
  const lab04::Integrand g = integrand(given.index(1));
  carlo::Rng rng = given.rng(4, 2);
  return {rms_error(given.whole(3), g.average,
                    [&] { return average_over(set.make(given.whole(2), rng), g); })};
}

/// One estimate by recursive stratification; the boxes are appended to `strata` unless it is null.
Estimate recursive(const lab04::Integrand& g, std::int64_t n, carlo::Rng& rng,
                   std::vector<Stratum>* strata = nullptr) {
  const FunctionNd f = [&g](std::span<const double> x) { return g.f(x[0], x[1]); };
  return recursive_stratification(f, 2, n, rng, strata);
}

/// integrand, n, runs, seed: the RMS error of recursive stratification.
Numbers recursive_error(const Arguments& given) {
  const lab04::Integrand g = integrand(given.index(0));
  carlo::Rng rng = given.rng(3, 1);
  return {rms_error(given.whole(2), g.average,
                    [&] { return recursive(g, given.whole(1), rng).value; })};
}

/// integrand, n, seed: the estimate, its standard error, the average; then each box: its lower and
/// upper corner and its points.
Numbers boxes(const Arguments& given) {
  const lab04::Integrand g = integrand(given.index(0));
  carlo::Rng rng = given.rng(2, 1);
  std::vector<Stratum> strata;
  const Estimate estimate = recursive(g, given.whole(1), rng, &strata);
  Numbers results = {estimate.value, estimate.standard_error, g.average};
  for (const Stratum& s : strata)
    results.insert(results.end(),
                   {s.lower[0], s.lower[1], s.upper[0], s.upper[1], static_cast<double>(s.points)});
  return results;
}

const Function functions[] = {{"4.points", points},
                              {"4.values", values},
                              {"4.set", set_error},
                              {"4.recursive", recursive_error},
                              {"4.boxes", boxes}};

}  // namespace
}  // namespace site
