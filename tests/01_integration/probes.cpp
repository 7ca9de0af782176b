// Probes of lab 01's exercises on the line: 1.1 to 1.4. They call the student's functions and
// return raw values; what the values should be stands in checks_*.cpp.

#include "01_integration/integrands.h"
#include "01_integration/recorder.h"
#include "grader/worker/probe.h"
#include "grader/worker/words_drawn.h"
#include "integration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace lab01_tests;
using carlo::grader::Params;
using carlo::grader::Rows;
using carlo::grader::RowWriter;
using carlo::grader::words_drawn;

namespace {

lab01::Function power_function(const Params& params) {
  const auto k = static_cast<int>(params.whole("k"));
  return [k](double x) { return power(x, k); };
}

/// The first `count` values, filled up with NaN where there are fewer.
Rows as_column(std::vector<double> values, std::int64_t count) {
  values.resize(static_cast<std::size_t>(count), std::numeric_limits<double>::quiet_NaN());
  return {1, std::move(values)};
}

/// Number i of the lists that Moments is fed with: the offset plus a repeating pattern.
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

double apply_rule(const Params& params, const lab01::Function& f) {
  const double a = params["a"];
  const double b = params["b"];
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
PROBE("Lab 1.1 estimates") {
  carlo::Rng rng(params.seed);
  const lab01::Function f = power_function(params);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({lab01::average(f, params.n, rng)});
  }
  return rows.take();
}

PROBE("Lab 1.1 record") {
  carlo::Rng rng(params.seed);
  const carlo::Rng before = rng;
  Recorder recorder;
  const double value = lab01::average(recorder.watch(power_function(params)), params.n, rng);
  return {6,
          {value, recorder.count(), recorder.lowest(), recorder.highest(), recorder.mean(),
           words_drawn(before, rng, 4 * params.n + 64)}};
}

PROBE("Lab 1.1 points") {
  carlo::Rng rng(params.seed);
  Recorder recorder;
  lab01::average(recorder.watch([](double x) { return x; }), params.n, rng);
  return as_column(recorder.points(), params.n);
}

PROBE("Lab 1.2 estimates") {
  carlo::Rng rng(params.seed);
  const lab01::Function f = power_function(params);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({lab01::integrate(f, params["a"], params["b"], params.n, rng)});
  }
  return rows.take();
}

PROBE("Lab 1.2 record") {
  carlo::Rng rng(params.seed);
  const carlo::Rng before = rng;
  Recorder recorder;
  const double value = lab01::integrate(recorder.watch(power_function(params)), params["a"],
                                        params["b"], params.n, rng);
  return {6,
          {value, recorder.count(), recorder.lowest(), recorder.highest(), recorder.mean(),
           words_drawn(before, rng, 4 * params.n + 64)}};
}

PROBE("Lab 1.2 points") {
  carlo::Rng rng(params.seed);
  Recorder recorder;
  lab01::integrate(recorder.watch([](double x) { return x; }), params["a"], params["b"], params.n,
                   rng);
  return as_column(recorder.points(), params.n);
}

PROBE("Lab 1.3 list") {
  RowWriter rows;
  write(rows, moments_of(params, 0, params.n));
  return rows.take();
}

// Every way to cut n numbers into three parts, empty ones too; the parts are merged in order.
PROBE("Lab 1.3 merge") {
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

PROBE("Lab 1.3 merge many") {
  lab01::Moments merged;
  const std::int64_t length = params.whole("length");
  for (std::int64_t first = 0; first < params.n; first += length) {
    merged.merge(moments_of(params, first, first + length));
  }
  RowWriter rows;
  write(rows, merged);
  return rows.take();
}

// A list that nobody can know before: first its numbers, one a row, then the moments of the whole
// and those of two parts merged.
PROBE("Lab 1.3 unknown list") {
  carlo::Rng rng(params.seed);
  const auto cut = static_cast<std::int64_t>(rng.uniform() * static_cast<double>(params.n));
  RowWriter rows;
  lab01::Moments whole, first, second;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const double x = 10 * rng.uniform() * rng.uniform();
    rows.add({x, 0, 0, 0});
    whole.add(x);
    (i < cut ? first : second).add(x);
  }
  first.merge(second);
  write(rows, whole);
  write(rows, first);
  return rows.take();
}

PROBE("Lab 1.4 rule") {
  Recorder recorder;
  const double value = apply_rule(params, recorder.watch(power_function(params)));
  return {3, {value, recorder.count(), recorder.highest()}};
}

PROBE("Lab 1.4 points") {
  Recorder recorder;
  apply_rule(params, recorder.watch([](double x) { return x; }));
  std::vector<double> points = recorder.points();
  std::sort(points.begin(), points.end());
  return as_column(std::move(points), params.whole("points"));
}
