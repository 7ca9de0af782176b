// Probes of exercises 2.1 to 2.4. They call the student's functions and return raw values;
// checks_*.cpp says what the values should be.

#include "02_pi/drawn.h"
#include "02_pi/reference.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "pi.h"

using namespace lab02_tests;
using carlo::grader::next_words;
using carlo::grader::NextWords;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

lab02::Darts darts_of(const Params& params) {
  return {params.whole("thrown"), params.whole("hits")};
}

Integrand integrand_of(const Params& params) {
  return params.whole("integrand") == 0 ? Integrand::circle : Integrand::arctangent;
}

lab02::Sums sums_of(const Params& params, carlo::Rng& rng) {
  return integrand_of(params) == Integrand::circle ? lab02::sum_circle(params.n, rng)
                                                   : lab02::sum_arctangent(params.n, rng);
}

}  // namespace

// All repetitions share one generator: a function that restarts it repeats itself.
PROBE("Lab 2.1 repeated", "hits") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({static_cast<double>(lab02::throw_darts(params.n, rng).hits)});
  }
  return rows.take();
}

PROBE("Lab 2.1 record", "thrown", "hits", "next word of rng", "next word 2", "next word 3",
      "next word 4") {
  carlo::Rng rng(params.seed);
  const lab02::Darts darts = lab02::throw_darts(params.n, rng);
  const NextWords next = next_words(rng);
  return {6,
          {static_cast<double>(darts.thrown), static_cast<double>(darts.hits), next[0], next[1],
           next[2], next[3]}};
}

PROBE("Lab 2.1 many", "thrown", "hits") {
  carlo::Rng rng(params.seed);
  const lab02::Darts darts = lab02::throw_darts(params.n, rng);
  return {2, {static_cast<double>(darts.thrown), static_cast<double>(darts.hits)}};
}

PROBE("Lab 2.1 estimate", "estimate", "standard error") {
  const lab02::Estimate estimate = lab02::pi_estimate(darts_of(params));
  return {2, {estimate.value, estimate.standard_error}};
}

PROBE("Lab 2.2 interval", "lower limit", "upper limit") {
  const lab02::Interval interval = lab02::pi_interval(darts_of(params), params["z"]);
  return {2, {interval.lower, interval.upper}};
}

PROBE("Lab 2.2 drawn intervals", "lower limit", "upper limit") {
  RowWriter rows;
  for (const IntervalQuestion& asked : drawn_intervals(params.seed, params.n)) {
    const lab02::Interval interval = lab02::pi_interval({asked.thrown, asked.hits}, asked.z);
    rows.add({interval.lower, interval.upper});
  }
  return rows.take();
}

// The probability of a hit is a parameter: Lab 2.2 can be judged before Lab 2.1 is done, and for
// rare hits.
PROBE("Lab 2.2 intervals", "lower limit", "upper limit") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    lab02::Darts darts{params.n, 0};
    for (std::int64_t j = 0; j < params.n; ++j)
      darts.hits += rng.uniform() < params["p"] ? 1 : 0;
    const lab02::Interval interval = lab02::pi_interval(darts, params["z"]);
    rows.add({interval.lower, interval.upper});
  }
  return rows.take();
}

PROBE("Lab 2.3 record", "count", "sum", "squares", "next word of rng", "next word 2", "next word 3",
      "next word 4") {
  carlo::Rng rng(params.seed);
  const lab02::Sums sums = sums_of(params, rng);
  const NextWords next = next_words(rng);
  return {7,
          {static_cast<double>(sums.count), sums.sum, sums.squares, next[0], next[1], next[2],
           next[3]}};
}

PROBE("Lab 2.3 repeated", "mean") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({sums_of(params, rng).sum / static_cast<double>(params.n)});
  }
  return rows.take();
}

PROBE("Lab 2.3 mean", "mean", "standard error") {
  const lab02::Estimate estimate =
      lab02::mean_of({params.whole("count"), params["sum"], params["squares"]});
  return {2, {estimate.value, estimate.standard_error}};
}

PROBE("Lab 2.4 deviations", "of darts", "of the circle", "of the arctangent") {
  return {3, {lab02::darts_deviation(), lab02::circle_deviation(), lab02::arctangent_deviation()}};
}

PROBE("Lab 2.4 samples", "samples") {
  return {1,
          {static_cast<double>(
              lab02::samples_needed(params["deviation"], params["half_width"], params["z"]))}};
}

PROBE("Lab 2.4 drawn samples", "samples") {
  RowWriter rows;
  for (const PlanQuestion& asked : drawn_plans(params.seed, params.n)) {
    const std::int64_t samples = lab02::samples_needed(asked.deviation, asked.half_width, asked.z);
    rows.add({static_cast<double>(samples)});
  }
  return rows.take();
}
