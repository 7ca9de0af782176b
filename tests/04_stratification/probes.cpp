// Probes of lab 4's exercises 4.1 to 4.5. They call the student's functions and return raw values;
// checks_*.cpp says what the values should be.

#include "04_stratification/drawn.h"
#include "04_stratification/integrands.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "stratification.h"

#include <limits>
#include <vector>

using namespace lab04_tests;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

// All repetitions share one generator: an estimate that restarts it repeats itself.
PROBE("Lab 4.1 estimates", "estimate") {
  carlo::Rng rng(params.seed);
  const auto k = static_cast<int>(params.whole("k"));
  const lab04::Function f = [k](double x) { return power(x, k); };
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i)
    rows.add({lab04::stratified_average(f, params.n, rng)});
  return rows.take();
}

// The estimate of x^2, the number of evaluations of f, the generator's next words; then n points,
// padded or truncated.
PROBE("Lab 4.1 record", "estimate", "evaluations of f", "next word of rng", "next word 2",
      "next word 3", "next word 4", "point", "(nan: f was asked less often)") {
  carlo::Rng rng(params.seed);
  std::vector<double> places;
  const double value = lab04::stratified_average(
      [&](double x) {
        places.push_back(x);
        return x * x;
      },
      params.n, rng);
  const auto asked = static_cast<double>(places.size());
  places.resize(static_cast<std::size_t>(params.n), std::numeric_limits<double>::quiet_NaN());
  Rows rows{1, {value, asked}};
  const auto next = carlo::grader::next_words(rng);
  rows.values.insert(rows.values.end(), next.begin(), next.end());
  rows.values.insert(rows.values.end(), places.begin(), places.end());
  return rows;
}

// The position returned for each of drawn_shares().
PROBE("Lab 4.2 places", "x", "(for strata and numbers u that follow from the seed)") {
  const auto n = static_cast<std::int32_t>(params.n);
  Rows rows{1, {}};
  for (const Share& share : drawn_shares(params.seed, n, params.whole("places")))
    rows.values.push_back(lab04::place_in_stratum(share.stratum, n, share.u));
  return rows;
}

// First the number of points; then the points, padded with NaN or truncated.
PROBE("Lab 4.3 points", "x", "y", "(row 1: how many points came, and 0; nan: no point came)") {
  carlo::Rng rng(params.seed);
  const auto points = lab04::jittered(params.whole("columns"), params.whole("rows"), rng);
  const auto wanted = static_cast<std::size_t>(params.whole("columns") * params.whole("rows"));
  std::vector<double> values = {static_cast<double>(points.size()), 0};
  for (std::size_t i = 0; i < wanted; ++i) {
    const bool there = i < points.size();
    values.push_back(there ? points[i].x : std::numeric_limits<double>::quiet_NaN());
    values.push_back(there ? points[i].y : std::numeric_limits<double>::quiet_NaN());
  }
  return {2, std::move(values)};
}

// One row per hypercube: its number of coordinates, then the coordinates, padded with NaN or
// truncated.
PROBE("Lab 4.4 hypercubes", "coordinates", "coordinate ...",
      "(a row a hypercube: how many coordinates came, then they, point by point; nan: none came)") {
  carlo::Rng rng(params.seed);
  const std::int64_t d = params.whole("dimensions");
  const auto wanted = static_cast<std::size_t>(params.n * d);
  Rows rows{wanted + 1, {}};
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    std::vector<double> points = lab04::latin_hypercube(params.n, d, rng);
    rows.values.push_back(static_cast<double>(points.size()));
    points.resize(wanted, std::numeric_limits<double>::quiet_NaN());
    rows.values.insert(rows.values.end(), points.begin(), points.end());
  }
  return rows;
}

PROBE("Lab 4.5 estimates", "value", "standard error", "plain standard error") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  const lab04::Function2d f = [](double x, double y) { return x * y; };
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    const auto e = lab04::stratified_estimate(f, params.whole("columns"), params.whole("rows"),
                                              params.whole("per_cell"), rng);
    rows.add({e.value, e.standard_error, e.plain_standard_error});
  }
  return rows.take();
}

// The three results; the number of evaluations of f; then every point, padded or truncated.
PROBE("Lab 4.5 record", "x", "y",
      "(row 1: value and standard error; row 2: plain standard error and evaluations of f; then "
      "where f was asked; nan: it was asked less often)") {
  carlo::Rng rng(params.seed);
  Rows places{2, {}};
  const DrawnPlane plane = drawn_plane(params.seed, params["offset"]);
  const lab04::Function2d f = [&](double x, double y) {
    places.values.insert(places.values.end(), {x, y});
    return plane(x, y);
  };
  const std::int64_t columns = params.whole("columns"), rows = params.whole("rows");
  const auto e = lab04::stratified_estimate(f, columns, rows, params.whole("per_cell"), rng);
  const auto asked = static_cast<double>(places.count());
  places.values.resize(static_cast<std::size_t>(2 * columns * rows * params.whole("per_cell")),
                       std::numeric_limits<double>::quiet_NaN());
  places.values.insert(places.values.begin(),
                       {e.value, e.standard_error, e.plain_standard_error, asked});
  return places;
}
