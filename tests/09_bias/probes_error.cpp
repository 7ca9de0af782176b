// Probes of exercise 9.1: they call the student's functions and return raw values; checks_error.cpp
// says what the values should be.

#include "09_bias/error_data.h"
#include "bias.h"
#include "grader/worker/probe.h"

#include <algorithm>

using namespace lab09_tests;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

PROBE("Lab 9.1 short lists", "bias^2", "variance") {
  RowWriter rows;
  for (const Estimates& list : {Estimates{5, {4, 8}}, Estimates{3, {2, 6, 7}}}) {
    const lab09::ErrorParts parts = lab09::split_error(list.values, list.exact);
    rows.add({parts.bias2, parts.variance});
  }
  return rows.take();
}

PROBE("Lab 9.1 drawn lists", "bias^2", "variance", "(second row: the same list backwards)") {
  Estimates list = drawn_estimates(
      estimates_cases().at(static_cast<std::size_t>(params.whole("case"))), params.seed, params.n);
  RowWriter rows;
  for (int way = 0; way < 2; ++way) {
    const lab09::ErrorParts parts = lab09::split_error(list.values, list.exact);
    rows.add({parts.bias2, parts.variance});
    std::reverse(list.values.begin(), list.values.end());
  }
  return rows.take();
}

PROBE("Lab 9.1 slope", "slope") {
  const ErrorCurve curve = drawn_curve(params.seed, params.n);
  return {1, {lab09::fitted_slope(curve.n, curve.error)}};
}

PROBE("Lab 9.1 overtakes", "seconds") {
  const Race race = drawn_race(params.seed);
  RowWriter rows;
  for (const Race& r : {race, Race{race.b, race.a, race.bias2}, Race{race.a, race.b, 0},
                        Race{race.a, race.b, -race.bias2}, Race{race.b, race.a, 0},
                        Race{race.b, race.a, -race.bias2}})
    rows.add({lab09::overtakes_after(r.a, r.b, r.bias2)});
  return rows.take();
}
