// Probes of lab 6's exercises 6.5 to 6.7.

#include "06_importance/inputs.h"
#include "06_importance/steps.h"
#include "grader/worker/probe.h"
#include "grader/worker/refusal.h"
#include "importance.h"

#include <cmath>
#include <vector>

using namespace lab06_tests;
using carlo::grader::Params;
using carlo::grader::refusal;
using carlo::grader::refusal_codes;
using carlo::grader::RowWriter;

namespace {

double step_value(double x) {
  return step_f[cell_of(x)];
}

lab06::Density step_density(const StepDensity& steps) {
  return {[steps](double u) { return steps.sample(u); },
          [steps](double x) { return steps.pdf_in(cell_of(x)); }};
}

/// Lab 6.7 is judged with correct weights, whatever Lab 6.6 returns.
double balance(lab06::Effort own, lab06::Effort other) {
  return plain_weight(Weighting::balance, own.samples, own.pdf, other.samples, other.pdf);
}
double power(lab06::Effort own, lab06::Effort other) {
  return plain_weight(Weighting::power, own.samples, own.pdf, other.samples, other.pdf);
}
lab06::Heuristic heuristic(const Params& params) {
  return static_cast<Weighting>(params.whole("weighting")) == Weighting::power ? power : balance;
}

/// The first technique: one that leaves part of f to the second, or one that covers f alone.
const StepDensity& first_steps(const Params& params) {
  return params.whole("wide") != 0 ? step_wide : step_first;
}

}  // namespace

PROBE("Lab 6.5 contributions", "contribution") {
  carlo::Rng rng(params.seed);
  const auto profile = static_cast<Profile>(params.whole("profile"));
  const Dartboard board = dartboard(profile);
  const auto f = [profile](double x) { return profile_f(profile, x); };
  const auto g = [profile](double x) { return profile_g(profile, x); };
  return {1, lab06::rejection_contributions(f, g, board.a, board.b, board.g_max, params.n, rng)};
}

PROBE("Lab 6.5 record", "contribution", "dart's first number", "its second number",
      "(last row: contributions that came, evaluations of f, 1 if rng is where it should be)") {
  carlo::Rng rng(params.seed);
  carlo::Rng copy = rng;
  const auto profile = static_cast<Profile>(params.whole("profile"));
  const Dartboard board = dartboard(profile);
  double evaluations = 0;
  const auto f = [&](double x) {
    evaluations += 1;
    return profile_f(profile, x);
  };
  const auto g = [&](double x) { return profile_g(profile, x); };
  const auto values =
      lab06::rejection_contributions(f, g, board.a, board.b, board.g_max, params.n, rng);
  RowWriter rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.n); ++i) {
    const double first = copy.uniform();
    const double second = copy.uniform();
    rows.add({i < values.size() ? values[i] : not_a_number, first, second});
  }
  rows.add({static_cast<double>(values.size()), evaluations,
            copy.uniform() == rng.uniform() ? 1.0 : 0.0});
  return rows.take();
}

// 0: g above its bound, 1: g negative, 2: g is NaN.
PROBE("Lab 6.5 broken promise", "refusal", refusal_codes) {
  carlo::Rng rng(params.seed);
  const auto kind = params.whole("kind");
  const auto g = [kind](double) { return kind == 0 ? 1.5 : kind == 1 ? -0.5 : not_a_number; };
  const auto one = [](double) { return 1.0; };
  return {1, {refusal([&] { (void)lab06::rejection_contributions(one, g, 0, 1, 1, 4, rng); })}};
}

PROBE("Lab 6.6 weights", "balance", "roles exchanged", "power", "roles exchanged") {
  RowWriter rows;
  for (const Pair& pair : pairs()) {
    const lab06::Effort own{pair.samples, pair.pdf}, other{pair.other_samples, pair.other_pdf};
    rows.add({lab06::balance_weight(own, other), lab06::balance_weight(other, own),
              lab06::power_weight(own, other), lab06::power_weight(other, own)});
  }
  return rows.take();
}

// The sums of a pair's weights, for pdfs over the whole range of double.
PROBE("Lab 6.6 sums", "balance", "sum of the two", "power", "sum of the two",
      "(the sums: own's weight and other's)") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const double samples = 1 + std::floor(100 * rng.uniform());
    const double pdf = std::pow(10, 600 * rng.uniform() - 300);
    const double other_samples = 1 + std::floor(100 * rng.uniform());
    // Most pairs are of similar size: there the weights are neither 0 nor 1.
    const double factor = std::pow(10, 8 * rng.uniform() - 4);
    const lab06::Effort own{samples, pdf}, other{other_samples, pdf * factor};
    const double b = lab06::balance_weight(own, other), p = lab06::power_weight(own, other);
    rows.add({b, b + lab06::balance_weight(other, own), p, p + lab06::power_weight(other, own)});
  }
  return rows.take();
}

PROBE("Lab 6.7 multi", "estimate") {
  carlo::Rng rng(params.seed);
  const lab06::Technique first{step_density(first_steps(params)), params.whole("n_first")};
  const lab06::Technique second{step_density(step_second), params.whole("n_second")};
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    rows.add({lab06::multi_sample(step_value, first, second, heuristic(params), rng)});
  return rows.take();
}

PROBE("Lab 6.7 multi record", "estimate", "number of rng",
      "(the last: 1 if rng is where it should be)") {
  carlo::Rng rng(params.seed);
  carlo::Rng copy = rng;
  const lab06::Technique first{step_density(first_steps(params)), params.whole("n_first")};
  const lab06::Technique second{step_density(step_second), params.whole("n_second")};
  RowWriter rows;
  rows.add({lab06::multi_sample(step_value, first, second, heuristic(params), rng)});
  for (std::int64_t i = 0; i < first.samples + second.samples; ++i)
    rows.add({copy.uniform()});
  rows.add({copy.uniform() == rng.uniform() ? 1.0 : 0.0});
  return rows.take();
}

// Every sample of the first technique has pdf 0: it must contribute nothing, and no NaN.
PROBE("Lab 6.7 vanishing", "of two techniques, the first's pdf is 0",
      "of two techniques, both pdfs are 0", "of one sample, whose pdf is 0",
      "of one sample, the other's pdf is 0") {
  carlo::Rng rng(params.seed);
  const lab06::Density never{[](double) { return 0.5; }, [](double) { return 0.0; }};
  const lab06::Density even = lab06::uniform_density(0, 1);
  const auto two = [](double) { return 2.0; };
  const auto none = [](double) { return 0.0; };
  return {4,
          {lab06::multi_sample(two, {never, 3}, {even, 2}, balance, rng),
           lab06::multi_sample(none, {never, 3}, {never, 2}, power, rng),
           lab06::one_sample(two, never, even, 0.5, balance, 0.3),
           lab06::one_sample(two, never, even, 0.5, power, 0.8)}};
}

PROBE("Lab 6.7 one", "u", "contribution") {
  const double share = shares().at(static_cast<std::size_t>(params.whole("share")));
  const lab06::Density first = step_density(first_steps(params));
  const lab06::Density second = step_density(step_second);
  RowWriter rows;
  for (const double u : numbers_for(share))
    rows.add({u, lab06::one_sample(step_value, first, second, share, heuristic(params), u)});
  return rows.take();
}

PROBE("Lab 6.7 one numbers", "u", "number handed on") {
  const double share = shares().at(static_cast<std::size_t>(params.whole("share")));
  double handed = not_a_number;
  const lab06::Density note{[&handed](double u) {
                              handed = u;
                              return 0.5;
                            },
                            [](double) { return 1.0; }};
  RowWriter rows;
  for (const double u : numbers_for(share)) {
    (void)lab06::one_sample([](double) { return 1.0; }, note, note, share, balance, u);
    rows.add({u, handed});
  }
  return rows.take();
}

PROBE("Lab 6.7 one estimates", "estimate") {
  carlo::Rng rng(params.seed);
  const lab06::Density first = step_density(first_steps(params));
  const lab06::Density second = step_density(step_second);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    rows.add({lab06::one_sample(step_value, first, second, params["share"], heuristic(params),
                                rng.uniform())});
  }
  return rows.take();
}
