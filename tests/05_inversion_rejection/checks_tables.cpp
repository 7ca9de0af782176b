// Checks of exercise 5.5, exact and by chi-square as those of 5.4.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "05_inversion_rejection/refusal.h"
#include "05_inversion_rejection/tables.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Diagnosis at_the_edge{"samples-at-bin-edges",
                            "all samples of a bin fall on its edge or centre: the remainder of u "
                            "places them within the bin."};

/// True if the samples lie in a neighbouring bin, all on the same side, where there is one.
bool in_next_bin(const std::vector<double>& u, const std::vector<double>& found,
                 const std::vector<double>& cdf) {
  const double bins = number(cdf.size());
  for (const double step : {-1.0, 1.0}) {
    std::size_t seen = 0, fit = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Place place = place_of(u[i], cdf);
      if (place.index + step < 0 || place.index + step >= bins) continue;
      ++seen;
      fit += std::abs(found[i] - (place.index + step + place.fraction) / bins) <= 1e-9 ? 1 : 0;
    }
    if (seen > 0 && fit == seen) return true;
  }
  return false;
}

/// True if these are the values of the neighbours, all on the same side, where there is one.
bool of_next_bin(const std::vector<double>& found, const std::vector<double>& expected) {
  const std::size_t n = expected.size();
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
  return n > 1 && (std::equal(found.begin(), found.end() - 1, expected.begin() + 1, same) ||
                   std::equal(found.begin() + 1, found.end(), expected.begin(), same));
}

}  // namespace

TEST_CASE("Lab 5.5: samples are the inverse of the CDF and never fall where the density is 0",
          "[lab05][ex5]") {
  for (const Weights kind :
       {Weights::eighths, Weights::gaps, Weights::sixths, Weights::rugged, Weights::comb}) {
    const std::vector<double> weights = weights_of(kind), cdf = exact_cdf(weights);
    const std::vector<double> u = numbers_for(weights);
    const Rows rows = probe("Lab 5.5 inverse", params_of(kind),
                            {.rows = u.size(), .columns = 2, .finite = false, .of = name_of(kind)});
    const double bins = number(weights.size());
    std::vector<double> at, found;
    double outside = 0, empty = 0;
    bool all_at_edges = true;
    for (std::size_t i = 0; i < u.size(); ++i) {
      outside += rows.at(i, 0) >= 0 && rows.at(i, 0) < 1 ? 0 : 1;
      empty += rows.at(i, 1) > 0 ? 0 : 1;
      all_at_edges = all_at_edges && (rows.at(i, 1) > 0 || at_edge(u[i], cdf));
      if (!exact_edges(kind) && near_edge(u[i], cdf)) continue;
      at.push_back(u[i]);
      found.push_back(rows.at(i, 0));
    }
    const auto inverse = [&](double v) {
      const Place place = place_of(v, cdf);
      return (place.index + place.fraction) / bins;
    };
    const auto twice = [&](double v) { return (place_of(v, cdf).index + v) / bins; };
    const auto left = [&](double v) { return place_of(v, cdf).index / bins; };
    const auto centre = [&](double v) { return (place_of(v, cdf).index + 0.5) / bins; };
    judge(equals(fmt::format("samples outside [0, 1), {}", name_of(kind)), outside, 0, 0));
    Verdict verdict =
        equals_everywhere(fmt::format("the sample of {}", name_of(kind)), at, found, inverse, 1e-9,
                          1e-13, {{twice, spent}, {left, at_the_edge}, {centre, at_the_edge}});
    if (!verdict.passed && in_next_bin(at, found, cdf)) verdict.diagnoses.push_back(next_bin);
    judge(verdict);
    judge(holds(fmt::format("samples whose density is 0, {}", name_of(kind)), empty == 0,
                fmt::format("{:g} of {}", empty, u.size()), "none",
                all_at_edges ? std::vector{slips} : std::vector<Diagnosis>{}));
  }
}

TEST_CASE("Lab 5.5: the density is that of each bin, and 0 outside [0, 1)", "[lab05][ex5]") {
  for (const Weights kind : {Weights::eighths, Weights::gaps, Weights::rugged}) {
    std::vector<double> expected = probabilities(weights_of(kind));
    const double bins = number(expected.size());
    const std::vector<double> plain = expected;
    for (double& p : expected)
      p *= bins;
    Rows rows = probe("Lab 5.5 density", params_of(kind),
                      {.rows = expected.size() + 4, .of = name_of(kind)});
    const std::vector<double> outside(rows.values.end() - 4, rows.values.end());
    rows.values.resize(expected.size());
    const bool unscaled = std::equal(plain.begin(), plain.end(), rows.values.begin(),
                                     [](double a, double b) { return std::abs(a - b) <= 1e-12; });
    std::vector<Diagnosis> diagnoses;
    if (unscaled) diagnoses.push_back(no_width);
    if (of_next_bin(rows.values, expected)) diagnoses.push_back(next_bin);
    judge(all_equal(fmt::format("the density of {}", name_of(kind)), rows.values, expected, 1e-11,
                    diagnoses));
    judge(all_equal("the density at -0.5, just below 0, at 1 and at 1.5", outside,
                    std::vector<double>(4, 0.0), 0));
  }
}

TEST_CASE("Lab 5.5: ten million bins", "[lab05][ex5]") {
  const std::vector<double> u = hard_numbers();
  const Rows rows = probe("Lab 5.5 many bins", {.n = 10'000'000},
                          {.rows = u.size(), .columns = 2, .of = "1e7 equal bins"});
  judge(equals_everywhere(
      "the sample of 1e7 equal bins", u, column(rows, 0), [](double v) { return v; }, 0, 1e-8));
  judge(all_equal("its density", column(rows, 1), std::vector<double>(u.size(), 1.0), 1e-8));
}

TEST_CASE("Lab 5.5: samples fill every half bin by its integral", "[lab05][ex5]") {
  constexpr std::size_t n = 400'000;
  Params params = params_of(Weights::gaps);
  params.n = n;
  const Rows rows = probe("Lab 5.5 samples", params, {.rows = n, .of = name_of(Weights::gaps)});
  std::vector<double> mass;
  for (const double p : probabilities(weights_of(Weights::gaps)))
    mass.insert(mass.end(), {p / 2, p / 2});
  judge(counts_are("the samples against the density's integral over each half bin",
                   counted(rows.values, 0, 1, mass.size()), mass, n, {"x", 0, 1}));
}
