// Probes of lab 1's exercises in several dimensions: 1.5 to 1.7.

#include "01_integration/drawn.h"
#include "01_integration/integrands.h"
#include "01_integration/recorder.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "integration.h"

#include <type_traits>
#include <vector>

using namespace lab01_tests;
using carlo::grader::next_words;
using carlo::grader::Params;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

// A box of temporary vectors would refer to nothing.
static_assert(!std::is_constructible_v<lab01::Box, std::vector<double>, std::vector<double>>);
static_assert(std::is_constructible_v<lab01::Box, std::vector<double>&, std::vector<double>&>);

namespace {

/// The corners of a box; the exercises take view().
struct Corners {
  std::vector<double> lower, upper;
  lab01::Box view() const { return {lower, upper}; }

  bool holds(std::span<const double> x) const {
    if (x.size() != lower.size()) return false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(x[i] >= lower[i] && x[i] < upper[i])) return false;
    }
    return true;
  }
};

Corners test_box(const Params& params) {
  Corners corners;
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.whole("d")); ++i) {
    corners.lower.push_back(lower(i));
    corners.upper.push_back(upper(i));
  }
  return corners;
}

Corners domain_box(const Params& params) {
  const auto d = static_cast<std::size_t>(params.whole("d"));
  return {{domain_lower, domain_lower + d}, {domain_upper, domain_upper + d}};
}

lab01::FunctionNd watched(BoxIntegrand kind, Recorder& recorder) {
  return [kind, &recorder](std::span<const double> x) {
    recorder.note(x);
    return evaluate(kind, x);
  };
}

void append(Rows& rows, const std::vector<double>& values) {
  rows.values.insert(rows.values.end(), values.begin(), values.end());
}

}  // namespace

PROBE("Lab 1.5 nested", "integral", "evaluations of f", "of them outside the box") {
  const Corners box = test_box(params);
  double count = 0, outside = 0;
  const auto kind = static_cast<BoxIntegrand>(params.whole("integrand"));
  const auto f = [&](std::span<const double> x) {
    count += 1;
    outside += box.holds(x) ? 0 : 1;
    return evaluate(kind, x);
  };
  const double value = lab01::nested_midpoint(f, box.view(), params.n);
  return {3, {value, count, outside}};
}

// For a function and a box that follow from the seed.
PROBE("Lab 1.5 drawn wave", "integral") {
  const DrawnWave wave = drawn_wave(params.seed, static_cast<std::size_t>(params.whole("d")));
  return {1, {lab01::nested_midpoint(wave, {wave.lower, wave.upper}, params.n)}};
}

PROBE("Lab 1.6 estimates", "estimate") {
  const Corners box = test_box(params);
  const auto kind = static_cast<BoxIntegrand>(params.whole("integrand"));
  const lab01::FunctionNd f = [kind](std::span<const double> x) { return evaluate(kind, x); };
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add({lab01::integrate_box(f, box.view(), params.n, rng)});
  }
  return rows.take();
}

// The estimate, the number of evaluations of f, the generator's next words; then the coordinates of
// the points at which f was evaluated.
PROBE("Lab 1.6 record", "estimate", "evaluations of f", "next word of rng", "next word 2",
      "next word 3", "next word 4", "coordinate") {
  const Corners box = test_box(params);
  Recorder recorder(params.n, box.lower.size());
  carlo::Rng rng(params.seed);
  const auto kind = static_cast<BoxIntegrand>(params.whole("integrand"));
  const double value = lab01::integrate_box(watched(kind, recorder), box.view(), params.n, rng);
  Rows rows{1, {value, recorder.count()}};
  const auto next = next_words(rng);
  append(rows, {next.begin(), next.end()});
  append(rows, recorder.points());
  return rows;
}

PROBE("Lab 1.7 estimates", "estimate", "standard error") {
  const Corners box = domain_box(params);
  const auto domain = static_cast<Domain>(params.whole("domain"));
  const auto kind = static_cast<DomainIntegrand>(params.whole("integrand"));
  const lab01::FunctionNd f = [kind](std::span<const double> x) { return evaluate(kind, x); };
  const lab01::Inside inside = [domain](std::span<const double> x) { return contains(domain, x); };
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    const lab01::Estimate estimate = lab01::integrate_domain(f, inside, box.view(), params.n, rng);
    rows.add({estimate.value, estimate.standard_error});
  }
  return rows.take();
}

// The estimate and its error; the numbers of calls of `inside` and f; the generator's next words;
// then the coordinates of these points, first all of `inside`, then those of f.
PROBE("Lab 1.7 record", "estimate", "standard error", "calls of inside", "evaluations of f",
      "next word of rng", "next word 2", "next word 3", "next word 4", "coordinate") {
  const Corners box = domain_box(params);
  const auto domain = static_cast<Domain>(params.whole("domain"));
  const auto kind = static_cast<DomainIntegrand>(params.whole("integrand"));
  Recorder asked(params.n, box.lower.size()), evaluated(params.n, box.lower.size());
  const lab01::FunctionNd f = [&](std::span<const double> x) {
    evaluated.note(x);
    return evaluate(kind, x);
  };
  const lab01::Inside inside = [&](std::span<const double> x) {
    asked.note_once(x);
    return contains(domain, x);
  };
  carlo::Rng rng(params.seed);
  const lab01::Estimate estimate = lab01::integrate_domain(f, inside, box.view(), params.n, rng);
  Rows rows{1, {estimate.value, estimate.standard_error, asked.count(), evaluated.count()}};
  const auto next = next_words(rng);
  append(rows, {next.begin(), next.end()});
  append(rows, asked.points());
  append(rows, evaluated.points());
  return rows;
}
