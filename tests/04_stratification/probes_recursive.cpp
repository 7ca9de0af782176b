// Probes of exercise 4.6.

#include "04_stratification/integrands.h"
#include "grader/worker/probe.h"
#include "stratification.h"

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace lab04_tests;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

PROBE("Lab 4.6 estimates", "value", "standard error") {
  carlo::Rng rng(params.seed);
  const auto kind = static_cast<CubeIntegrand>(params.whole("integrand"));
  const lab04::FunctionNd f = [kind](std::span<const double> x) { return evaluate(kind, x); };
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    const auto e = lab04::recursive_stratification(f, params.whole("d"), params.n, rng);
    rows.add({e.value, e.standard_error});
  }
  return rows.take();
}

// A point of the wrong dimension counts as one outside the cube.
PROBE("Lab 4.6 record", "value", "standard error", "evaluations of f", "of them outside the cube",
      "share in [0, 1/4)^2", "strata") {
  carlo::Rng rng(params.seed);
  const auto kind = static_cast<CubeIntegrand>(params.whole("integrand"));
  const auto d = static_cast<std::size_t>(params.whole("d"));
  double asked = 0, outside = 0, in_corner = 0;
  const lab04::FunctionNd f = [&](std::span<const double> x) {
    const bool inside =
        x.size() == d && std::all_of(x.begin(), x.end(), [](double c) { return c >= 0 && c < 1; });
    asked += 1;
    outside += inside ? 0 : 1;
    if (!inside) return 0.0;
    in_corner += d > 1 && x[0] < 0.25 && x[1] < 0.25 ? 1 : 0;
    return evaluate(kind, x);
  };
  std::vector<lab04::Stratum> strata;
  const auto e =
      lab04::recursive_stratification(f, static_cast<std::int64_t>(d), params.n, rng, &strata);
  return {6,
          {e.value, e.standard_error, asked, outside, in_corner / std::max(asked, 1.0),
           static_cast<double>(strata.size())}};
}

PROBE("Lab 4.6 strata", "lower ...", "upper ...", "points",
      "(rows of zeros: there are no more strata)") {
  carlo::Rng rng(params.seed);
  const auto kind = static_cast<CubeIntegrand>(params.whole("integrand"));
  const lab04::FunctionNd f = [kind](std::span<const double> x) { return evaluate(kind, x); };
  const auto d = static_cast<std::size_t>(params.whole("d"));
  std::vector<lab04::Stratum> strata;
  lab04::recursive_stratification(f, static_cast<std::int64_t>(d), params.n, rng, &strata);
  const std::size_t columns = 2 * d + 1;
  Rows rows{columns, std::vector<double>(static_cast<std::size_t>(params.n) * columns, 0.0)};
  for (std::size_t i = 0; i < strata.size() && i < static_cast<std::size_t>(params.n); ++i) {
    double* row = &rows.values[i * columns];
    for (std::size_t k = 0; k < d; ++k) {
      row[k] = strata[i].lower.at(k);
      row[d + k] = strata[i].upper.at(k);
    }
    row[2 * d] = static_cast<double>(strata[i].points);
  }
  return rows;
}
