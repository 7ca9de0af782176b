// Probes of lab 1's exercises on the line: 1.1 to 1.4. They call the student's functions and
// return raw values; checks_*.cpp says what the values should be.

#include "01_integration/drawn.h"
#include "01_integration/integrands.h"
#include "01_integration/recorder.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "integration.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace lab01_tests;
using carlo::grader::next_words;
using carlo::grader::Params;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

namespace {

lab01::Function power_function(const Params& params) {
  const auto k = static_cast<int>(params.whole("k"));
  return [k](double x) { return power(x, k); };
}

/// The result, the number of evaluations of f, the generator's next words; then the points at which
/// f was evaluated.
Rows record_of(double value, const Recorder& recorder, const carlo::Rng& after) {
  Rows rows{1, {value, recorder.count()}};
  const auto next = next_words(after);
  rows.values.insert(rows.values.end(), next.begin(), next.end());
  const std::vector<double> points = recorder.points();
  rows.values.insert(rows.values.end(), points.begin(), points.end());
  return rows;
}

/// Number i of the lists for Moments: the offset plus a repeating pattern.
double list_number(const Params& params, std::int64_t i) {
  constexpr std::array<double, 8> mixed{2, 4, 4, 4, 5, 5, 7, 9};
  const double alternating = i % 2 == 0 ? -1 : 1;
  const double growing = static_cast<double>(i) * static_cast<double>(i);
  switch (params.whole("pattern")) {
    case 0:
      return params["offset"] + mixed[static_cast<std::size_t>(i % 8)];
    case 1:
      return params["offset"] + alternating;
    default:
      return params["offset"] + growing;
  }
}

lab01::Moments moments_of(const Params& params, std::int64_t first, std::int64_t last) {
  lab01::Moments moments;
  for (std::int64_t i = first; i < last; ++i)
    moments.add(list_number(params, i));
  return moments;
}

void write(RowWriter& writer, const lab01::Moments& moments) {
  writer.add({static_cast<double>(moments.count()), moments.mean(), moments.variance(),
              moments.standard_error()});
}

double apply_rule(const Params& params, const lab01::Function& f, double a, double b) {
  switch (params.whole("rule")) {
    case 0:
      return lab01::midpoint(f, a, b, params.n);
    case 1:
      return lab01::trapezoid(f, a, b, params.n);
    case 2:
      return lab01::simpson(f, a, b, params.n);
    default:
      throw std::invalid_argument("no such rule");
  }
}

}  // namespace

// All repetitions share one generator: an estimate that restarts it repeats itself.
PROBE("Lab 1.1 estimates", "estimate") {
  carlo::Rng rng(params.seed);
  const lab01::Function f = power_function(params);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({lab01::average(f, params.n, rng)});
  }
  return rows.take();
}

PROBE("Lab 1.1 record", "estimate", "evaluations of f", "next word of rng", "next word 2",
      "next word 3", "next word 4", "point") {
  carlo::Rng rng(params.seed);
  Recorder recorder(params.n, 1);
  const double value = lab01::average(recorder.watch(power_function(params)), params.n, rng);
  return record_of(value, recorder, rng);
}

PROBE("Lab 1.1 points", "point") {
  carlo::Rng rng(params.seed);
  Recorder recorder(params.n, 1);
  lab01::average(recorder.watch([](double x) { return x; }), params.n, rng);
  return {1, recorder.points()};
}

PROBE("Lab 1.2 estimates", "estimate") {
  carlo::Rng rng(params.seed);
  const lab01::Function f = power_function(params);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({lab01::integrate(f, params["a"], params["b"], params.n, rng)});
  }
  return rows.take();
}

PROBE("Lab 1.2 record", "estimate", "evaluations of f", "next word of rng", "next word 2",
      "next word 3", "next word 4", "point") {
  carlo::Rng rng(params.seed);
  Recorder recorder(params.n, 1);
  const double value = lab01::integrate(recorder.watch(power_function(params)), params["a"],
                                        params["b"], params.n, rng);
  return record_of(value, recorder, rng);
}

PROBE("Lab 1.2 points", "point") {
  carlo::Rng rng(params.seed);
  Recorder recorder(params.n, 1);
  lab01::integrate(recorder.watch([](double x) { return x; }), params["a"], params["b"], params.n,
                   rng);
  return {1, recorder.points()};
}

PROBE("Lab 1.3 list", "count", "mean", "variance", "standard error") {
  RowWriter rows;
  write(rows, moments_of(params, 0, params.n));
  return rows.take();
}

// Every way to cut n numbers into three parts, including empty ones; the parts are merged in order.
PROBE("Lab 1.3 merge", "count", "mean", "variance", "standard error") {
  RowWriter rows;
  for (std::int64_t first = 0; first <= params.n; ++first) {
    for (std::int64_t second = first; second <= params.n; ++second) {
      lab01::Moments merged = moments_of(params, 0, first);
      merged.merge(moments_of(params, first, second));
      merged.merge(moments_of(params, second, params.n));
      write(rows, merged);
    }
  }
  return rows.take();
}

PROBE("Lab 1.3 merge many", "count", "mean", "variance", "standard error") {
  lab01::Moments merged;
  const std::int64_t length = params.whole("length");
  for (std::int64_t first = 0; first < params.n; first += length) {
    merged.merge(moments_of(params, first, first + length));
  }
  RowWriter rows;
  write(rows, merged);
  return rows.take();
}

// The moments of a list that follows from the seed, and those of two parts of it merged.
PROBE("Lab 1.3 drawn list", "count", "mean", "variance", "standard error") {
  const DrawnList list = drawn_list(params.seed, params.n);
  lab01::Moments whole, first, second;
  for (std::size_t i = 0; i < list.numbers.size(); ++i) {
    whole.add(list.numbers[i]);
    (i < list.cut ? first : second).add(list.numbers[i]);
  }
  first.merge(second);
  RowWriter rows;
  write(rows, whole);
  write(rows, first);
  return rows.take();
}

PROBE("Lab 1.4 rule", "integral", "evaluations of f", "largest x") {
  double count = 0, highest = -std::numeric_limits<double>::infinity();
  const lab01::Function f = power_function(params);
  const auto watched = [&](double x) {
    count += 1;
    highest = std::max(highest, x);
    return f(x);
  };
  const double value = apply_rule(params, watched, params["a"], params["b"]);
  return {3, {value, count, highest}};
}

PROBE("Lab 1.4 points", "point, in order") {
  Recorder recorder(params.whole("points"), 1);
  apply_rule(params, recorder.watch([](double x) { return x; }), params["a"], params["b"]);
  std::vector<double> points = recorder.points();
  std::sort(points.begin(), points.end());
  return {1, std::move(points)};
}

// For a function and an interval that follow from the seed.
PROBE("Lab 1.4 drawn wave", "integral") {
  const DrawnWave wave = drawn_wave(params.seed, 1);
  const auto f = [&](double x) { return wave(std::span(&x, 1)); };
  return {1, {apply_rule(params, f, wave.lower[0], wave.upper[0])}};
}
