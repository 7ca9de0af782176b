// Probes of lab 5's exercises 5.7 and 5.8.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/refusal.h"
#include "grader/worker/probe.h"
#include "grader/worker/refusal.h"
#include "inversion_rejection.h"

#include <cmath>
#include <limits>

using namespace lab05_tests;
using carlo::grader::Params;
using carlo::grader::refusal;
using carlo::grader::refusal_codes;
using carlo::grader::RowWriter;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Target target(const Params& params) {
  return static_cast<Target>(params.whole("target"));
}

/// The number of calls of uniform() between the states `before` and `after`, found by the next two
/// words; NaN if more than `limit`.
double numbers_drawn(carlo::Rng before, carlo::Rng after, std::int64_t limit) {
  const double first = after.uniform(), second = after.uniform();
  double a = before.uniform(), b = before.uniform();
  for (std::int64_t count = 0; count <= limit; ++count) {
    if (a == first && b == second) return static_cast<double>(count);
    a = b;
    b = before.uniform();
  }
  return not_a_number;
}

/// The two numbers of dart number `darts`, counted from 1.
struct Dart {
  double first = not_a_number, second = not_a_number;
};
Dart dart(carlo::Rng rng, std::int64_t darts) {
  if (darts < 1 || darts > 100'000) return {};
  for (std::int64_t i = 1; i < darts; ++i) {
    (void)rng.uniform();
    (void)rng.uniform();
  }
  const double first = rng.uniform();
  return {first, rng.uniform()};
}

}  // namespace

PROBE("Lab 5.7 samples", "x", "darts", "(nan: f was refused)") {
  carlo::Rng rng(params.seed);
  const Target t = target(params);
  const TargetCase c = target_case(t);
  const auto f = [t](double at) { return evaluate(t, at); };
  return rows_or_nan(static_cast<std::size_t>(params.n), 2, [&] {
    RowWriter rows;
    for (std::int64_t i = 0; i < params.n; ++i) {
      const auto [x, darts] = lab05::sample_by_rejection(f, c.a, c.b, c.bound, rng);
      rows.add({x, static_cast<double>(darts)});
    }
    return rows.take();
  });
}

// The results of a few calls, and the two numbers of the dart that each claims to have accepted.
PROBE("Lab 5.7 record", "x", "darts", "evaluations of f", "numbers drawn", "dart's first number",
      "its second number",
      "(the numbers of the dart that `darts` says was accepted; nan: f was refused)") {
  carlo::Rng rng(params.seed);
  const Target t = target(params);
  const TargetCase c = target_case(t);
  return rows_or_nan(static_cast<std::size_t>(params.n), 6, [&] {
    RowWriter rows;
    for (std::int64_t i = 0; i < params.n; ++i) {
      const carlo::Rng before = rng;
      double evaluations = 0;
      const auto watched = [&](double at) {
        evaluations += 1;
        return evaluate(t, at);
      };
      const auto [x, darts] = lab05::sample_by_rejection(watched, c.a, c.b, c.bound, rng);
      const Dart accepted = dart(before, darts);
      rows.add({x, static_cast<double>(darts), evaluations, numbers_drawn(before, rng, 100'000),
                accepted.first, accepted.second});
    }
    return rows.take();
  });
}

// 0: f above its bound, 1: f negative, 2: f is NaN.
PROBE("Lab 5.7 broken promise", "refusal", refusal_codes) {
  carlo::Rng rng(params.seed);
  const auto kind = params.whole("kind");
  const auto f = [kind](double x) {
    if (kind == 3 && x < 0.5) return 0.5;
    return kind == 0 ? 1.5 : kind == 1 ? -0.5 : not_a_number;
  };
  return {1, {refusal([&] {
            for (int i = 0; i < 100; ++i)  // a good half may hide the bad one from a single search
              (void)lab05::sample_by_rejection(f, 0, 1, 1, rng);
          })}};
}

PROBE("Lab 5.7 in vain", "refusal", "evaluations of f", refusal_codes) {
  carlo::Rng rng(params.seed);
  double evaluations = 0;
  const auto zero = [&](double) {
    evaluations += 1;
    return 0.0;
  };
  const double refused = refusal([&] { (void)lab05::sample_by_rejection(zero, 0, 1, 1, rng); });
  return {2, {refused, evaluations}};
}

PROBE("Lab 5.7 rate", "acceptance rate") {
  return {1,
          {lab05::acceptance_rate(params["integral"], params["a"], params["b"], params["bound"])}};
}

PROBE("Lab 5.8 rejection", "x", "y", "darts", "dart's first number", "its second number",
      "(the numbers of the dart that `darts` says was accepted)") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const carlo::Rng before = rng;
    const auto [p, darts] = lab05::disc_by_rejection(rng);
    const Dart accepted = dart(before, darts);
    rows.add({p.x, p.y, static_cast<double>(darts), accepted.first, accepted.second});
  }
  return rows.take();
}

PROBE("Lab 5.8 inversion at", "u_radius", "u_angle", "x", "y") {
  RowWriter rows;
  for (const double u_radius : hard_numbers()) {
    for (const double u_angle : {0.0, 0.1, 0.25, 0.5, 0.75, 0.875, last_below_one}) {
      const lab05::Point p = lab05::disc_by_inversion(u_radius, u_angle);
      rows.add({u_radius, u_angle, p.x, p.y});
    }
  }
  return rows.take();
}

PROBE("Lab 5.8 inversion", "x", "y") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const double u_radius = rng.uniform();
    const double u_angle = rng.uniform();
    const lab05::Point p = lab05::disc_by_inversion(u_radius, u_angle);
    rows.add({p.x, p.y});
  }
  return rows.take();
}

PROBE("Lab 5.8 density", "density") {
  return {1, {lab05::disc_pdf({params["x"], params["y"]})}};
}
