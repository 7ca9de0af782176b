// Probes of lab 6's exercises 6.1 to 6.4.

#include "06_importance/inputs.h"
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

/// (k + 1) x^k: its integral over [0, 1] is 1.
lab06::Function power_function(double k) {
  return [k](double x) { return (k + 1) * std::pow(x, k); };
}

std::vector<double> list_of(const Params& params) {
  return lab06_tests::list_of(static_cast<List>(params.whole("list")));
}

/// Two densities whose samples show which of them was called, by the sign, and with which number.
lab06::Density positive() {
  return {[](double u) { return u; }, positive_pdf};
}
lab06::Density negative() {
  return {[](double u) { return -u; }, negative_pdf};
}

}  // namespace

PROBE("Lab 6.1 contributions", "contribution") {
  carlo::Rng rng(params.seed);
  const auto values = lab06::contributions(power_function(params["k"]),
                                           lab06::power_density(params["n"]), params.n, rng);
  return {1, values};
}

// f where p covers only [0, edge).
PROBE("Lab 6.1 uncovered", "contribution") {
  carlo::Rng rng(params.seed);
  const auto values = lab06::contributions(
      power_function(params["k"]), lab06::uniform_density(0, params["edge"]), params.n, rng);
  return {1, values};
}

PROBE("Lab 6.1 answers", "contribution", "refusal", refusal_codes) {
  RowWriter rows;
  for (const Answers& a : answers()) {
    const lab06::Density p{[](double u) { return u; }, [&](double) { return a.pdf; }};
    double value = not_a_number;
    const double refused =
        refusal([&] { value = lab06::contribution([&](double) { return a.f; }, p, 0.5); });
    rows.add({value, refused});
  }
  return rows.take();
}

PROBE("Lab 6.1 at", "contribution") {
  const lab06::Density p{[](double u) { return u; }, [](double x) { return 2 + x; }};
  const auto f = [](double x) { return x * x; };
  return {1, {lab06::contribution(f, p, params["x"])}};
}

PROBE("Lab 6.1 record", "contribution", "number of rng", "number given to p.sample",
      "(last row: contributions that came, calls of p.sample, 1 if rng is where it should be)") {
  carlo::Rng rng(params.seed);
  carlo::Rng copy = rng;
  std::vector<double> asked;
  const lab06::Density p{[&](double u) {
                           asked.push_back(u);
                           return 3 * u;
                         },
                         [](double) { return 1.0 / 3; }};
  const auto values = lab06::contributions([](double x) { return x; }, p, params.n, rng);
  RowWriter rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.n); ++i) {
    rows.add({i < values.size() ? values[i] : not_a_number, copy.uniform(),
              i < asked.size() ? asked[i] : not_a_number});
  }
  rows.add({static_cast<double>(values.size()), static_cast<double>(asked.size()),
            copy.uniform() == rng.uniform() ? 1.0 : 0.0});
  return rows.take();
}

PROBE("Lab 6.2 summary", "value", "variance", "standard error") {
  const lab06::Estimate e = lab06::summarize(list_of(params));
  return {3, {e.value, e.variance, e.standard_error}};
}

PROBE("Lab 6.2 efficiency", "efficiency") {
  return {1, {lab06::efficiency(params["variance"], params["seconds"])}};
}

PROBE("Lab 6.3 samples", "u", "sample(u)", "pdf there",
      "(last row: nan, then the pdf below a and above b)") {
  const Light light = lights().at(static_cast<std::size_t>(params.whole("light")));
  const lab06::Density p = lab06::light_density(light.height, light.a, light.b);
  const double width = light.b - light.a;
  RowWriter rows;
  for (const double u : hard_numbers()) {
    const double t = p.sample(u);
    rows.add({u, t, p.pdf(t)});
  }
  rows.add({not_a_number, p.pdf(light.a - 0.01 * width), p.pdf(light.b + 0.01 * width)});
  return rows.take();
}

// The pdf at the middles of n equal cells of [a, b].
PROBE("Lab 6.3 pdf", "t", "pdf") {
  const Light light = lights().at(static_cast<std::size_t>(params.whole("light")));
  const lab06::Density p = lab06::light_density(light.height, light.a, light.b);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(params.n);
    const double t = light.a + (light.b - light.a) * share;
    rows.add({t, p.pdf(t)});
  }
  return rows.take();
}

PROBE("Lab 6.4 share", "largest share") {
  return {1, {lab06::largest_share(list_of(params))}};
}

PROBE("Lab 6.4 index", "tail index") {
  return {1, {lab06::tail_index(list_of(params), static_cast<std::size_t>(params.whole("k")))}};
}

// Pareto numbers of index a, half of them negative: 1 / estimate for each list of n.
PROBE("Lab 6.4 pareto", "1 / tail index") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  std::vector<double> values(static_cast<std::size_t>(params.n));
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    for (double& value : values) {
      const double sign = rng.uniform() < 0.5 ? -1 : 1;
      value = sign * std::pow(1 - rng.uniform(), -1 / params["a"]);
    }
    rows.add({1 / lab06::tail_index(values, static_cast<std::size_t>(params.whole("k")))});
  }
  return rows.take();
}

PROBE("Lab 6.4 mixture", "u", "q was asked", "with the number", "pdf at u", "pdf at -u") {
  const double share = shares().at(static_cast<std::size_t>(params.whole("share")));
  const lab06::Density p = lab06::mixture(positive(), negative(), share);
  RowWriter rows;
  for (const double u : numbers_for(share)) {
    const double x = p.sample(u);
    rows.add({u, std::signbit(x) ? 1.0 : 0.0, std::abs(x), p.pdf(u), p.pdf(-u)});
  }
  return rows.take();
}
