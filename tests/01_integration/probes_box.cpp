// Probes of lab 01's exercises in several dimensions: 1.5 to 1.7.

#include "01_integration/integrands.h"
#include "grader/worker/probe.h"
#include "grader/worker/words_drawn.h"
#include "integration.h"

#include <vector>

using namespace lab01_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;
using carlo::grader::words_drawn;

namespace {

/// The corners of a box; view() is what the exercises take.
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

/// Counts the evaluations and those outside, and adds up the values: all of them, and those inside.
struct Watch {
  double count = 0, outside = 0;
  long double sum = 0, sum_inside = 0;

  double note(double value, bool inside) {
    count += 1;
    outside += inside ? 0 : 1;
    sum += value;
    if (inside) sum_inside += value;
    return value;
  }
  double mean() const { return count > 0 ? static_cast<double>(sum / count) : 0; }
};

lab01::FunctionNd watched(BoxIntegrand kind, const Corners& box, Watch& watch) {
  return [kind, &box, &watch](std::span<const double> x) {
    return watch.note(evaluate(kind, x), box.holds(x));
  };
}

}  // namespace

PROBE("Lab 1.5 nested") {
  const Corners box = test_box(params);
  Watch watch;
  const auto kind = static_cast<BoxIntegrand>(params.whole("integrand"));
  const double value = lab01::nested_midpoint(watched(kind, box, watch), box.view(), params.n);
  return {3, {value, watch.count, watch.outside}};
}

PROBE("Lab 1.6 estimates") {
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

PROBE("Lab 1.6 record") {
  const Corners box = test_box(params);
  Watch watch;
  carlo::Rng rng(params.seed);
  const carlo::Rng before = rng;
  const auto kind = static_cast<BoxIntegrand>(params.whole("integrand"));
  const double value = lab01::integrate_box(watched(kind, box, watch), box.view(), params.n, rng);
  const double words = words_drawn(before, rng, 4 * params.n * params.whole("d") + 64);
  return {5, {value, watch.count, watch.outside, watch.mean(), words}};
}

PROBE("Lab 1.7 estimates") {
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

// Columns: the estimate and its error; how often f was asked, and outside the domain; how many
// points were asked for, and outside the box; how many of them lay inside; the sum of f over those
// where it was asked inside; the generator's words.
PROBE("Lab 1.7 record") {
  const Corners box = domain_box(params);
  const auto domain = static_cast<Domain>(params.whole("domain"));
  const auto kind = static_cast<DomainIntegrand>(params.whole("integrand"));
  Watch values;
  double asked = 0, outside_box = 0, accepted = 0;
  const lab01::FunctionNd f = [&](std::span<const double> x) {
    return values.note(evaluate(kind, x), contains(domain, x));
  };
  const lab01::Inside inside = [&](std::span<const double> x) {
    const bool is_inside = contains(domain, x);
    asked += 1;
    outside_box += box.holds(x) ? 0 : 1;
    accepted += is_inside ? 1 : 0;
    return is_inside;
  };
  carlo::Rng rng(params.seed);
  const carlo::Rng before = rng;
  const lab01::Estimate estimate = lab01::integrate_domain(f, inside, box.view(), params.n, rng);
  const double words = words_drawn(before, rng, 4 * params.n * params.whole("d") + 64);
  return {9,
          {estimate.value, estimate.standard_error, values.count, values.outside, asked,
           outside_box, accepted, static_cast<double>(values.sum_inside), words}};
}
