// Checks of exercise 5.4. Nearly all are exact: a table's inverse CDF is known. A chi-square test
// of 400 000 samples in 250 cells detects cells that are off by 4 % (rms): noncentrality 640; power
// .999 needs 290.

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

const Diagnosis zero_drawn{"weight-0-drawn",
                           "a number of weight 0 is drawn: search for the first CDF entry above "
                           "u, not for one that is at least u; and trailing zeros keep the last "
                           "sum."};
const Diagnosis edge_to_lower{"edge-goes-to-the-lower-number",
                              "a u that equals a CDF entry belongs to the next number: search for "
                              "the first entry above u, not for one that is at least u."};
const Diagnosis next_number{
    "neighbouring-number",
    "this is the result for the number next to it: number i has the part of [0, 1) from the "
    "CDF's previous entry to its own."};
const Diagnosis float_cdf{"cdf-in-float",
                          "float sums drift over millions of terms, and lose weights that are "
                          "much smaller than they are: add up in double."};
const Diagnosis float_u{"u-in-float",
                        "u becomes a float: its steps of 6e-8 never find a share of 1e-9, and the "
                        "fraction has few digits left. Keep it double."};
const Diagnosis fraction_of_one{"fraction-reaches-one",
                                "both differences of (u - C_(i-1))/(C_i - C_(i-1)) are rounded, "
                                "and may be equal although u is below C_i: keep the fraction "
                                "below 1."};
const Diagnosis not_stretched{"remainder-not-stretched",
                              "u minus the CDF entry before it still has to be divided by the "
                              "number's share."};
const Diagnosis cumulative{"cdf-for-probability",
                           "this is the CDF's entry; the probability is its distance from the one "
                           "before."};
const Diagnosis sum_overflows{"sum-overflows",
                              "finite weights may have an infinite sum, and dividing by it gives "
                              "no probabilities: check the sum as well."};

const Diagnosis sums_not_divided{"sums-not-divided-by-the-last",
                                 "the sums are not divided by the last one, the sum of all "
                                 "weights: the CDF does not end at 1."};
const Diagnosis weights_not_used{"weights-not-used",
                                 "all numbers have the same share, whatever their weights."};
const Diagnosis fraction_missing{"fraction-missing",
                                 "the fraction is 0 for every u: it says where u lies in the "
                                 "number's part of [0, 1)."};

/// True if all numbers drawn are off by one, on the same side, where there is a neighbour.
bool draws_next_number(const std::vector<double>& u, const Rows& rows,
                       const std::vector<double>& cdf) {
  if (cdf.size() < 2) return false;
  for (const double step : {-1.0, 1.0}) {
    bool all = true;
    for (std::size_t i = 0; i < u.size() && all; ++i) {
      if (near_edge(u[i], cdf)) continue;
      const double there = place_of(u[i], cdf).index + step;
      all = rows.at(i, 0) == std::clamp(there, 0.0, number(cdf.size() - 1));
    }
    if (all) return true;
  }
  return false;
}

/// True if the fractions are those of u in a neighbouring share, all on the same side, where there
/// is one.
bool fractions_of_next_number(const std::vector<double>& u, const Rows& rows,
                              const std::vector<double>& cdf) {
  for (const std::ptrdiff_t step : {-1, 1}) {
    std::size_t seen = 0, fit = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto there = static_cast<std::ptrdiff_t>(place_of(u[i], cdf).index) + step;
      if (there < 0 || there >= static_cast<std::ptrdiff_t>(cdf.size())) continue;
      const auto at = static_cast<std::size_t>(there);
      const double before = at == 0 ? 0 : cdf[at - 1],
                   fraction = (u[i] - before) / (cdf[at] - before);
      if (near_edge(u[i], cdf) || !std::isfinite(fraction)) continue;
      ++seen;
      fit += std::abs(rows.at(i, 1) - fraction) <= 1e-6 * (1 + std::abs(fraction)) ? 1 : 0;
    }
    if (seen > 0 && fit == seen) return true;
  }
  return false;
}

/// True if the numbers drawn are those of u as a float, and not all those of u.
bool draws_by_float(const std::vector<double>& u, const Rows& rows,
                    const std::vector<double>& cdf) {
  bool differ = false;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto v = static_cast<double>(std::min(static_cast<float>(u[i]), 0x1.fffffep-1f));
    if (near_edge(v, cdf) || near_edge(u[i], cdf)) continue;
    const double there = place_of(v, cdf).index;
    if (rows.at(i, 0) != there) return false;
    differ = differ || there != place_of(u[i], cdf).index;
  }
  return differ;
}

/// True if the rare weights' probabilities are as after rounding to float, and those of the others
/// are right.
bool probabilities_by_float() {
  const std::vector<double> weights = weights_of(Weights::rare);
  const Rows rows = probe("Lab 5.4 probabilities", params_of(Weights::rare),
                          {.rows = weights.size(), .finite = false, .of = name_of(Weights::rare)});
  double all = 0;
  for (const double weight : weights)
    all += weight;
  bool off = false, near = true;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double error = std::abs(rows.at(i, 0) - weights[i] / all);
    off = off || error > 1e-3 * weights[i] / all;
    near = near && error < 2e-7;
  }
  return off && near;
}

/// True if the numbers drawn are those of equal weights.
bool draws_uniformly(const std::vector<double>& u, const Rows& rows, std::size_t weights) {
  const double n = number(weights);
  for (std::size_t i = 0; i < u.size(); ++i)
    if (rows.at(i, 0) != std::min(std::floor(u[i] * n), n - 1)) return false;
  return weights > 1;
}

/// True if these are the right probabilities times a factor other than 1.
bool proportional(const std::vector<double>& found, const std::vector<double>& expected) {
  const auto first = std::find_if(expected.begin(), expected.end(), [](double p) { return p > 0; });
  const double factor = found[static_cast<std::size_t>(first - expected.begin())] / *first;
  if (!(std::isfinite(factor) && std::abs(factor - 1) > 1e-9 && factor > 0)) return false;
  return std::equal(found.begin(), found.end(), expected.begin(), [&](double a, double b) {
    return std::abs(a - factor * b) <= 1e-9 * factor * b;
  });
}

/// The same of the probabilities that the table itself gives.
bool proportional(Weights kind) {
  const std::vector<double> expected = probabilities(weights_of(kind));
  const Rows rows = probe("Lab 5.4 probabilities", params_of(kind),
                          {.rows = expected.size(), .finite = false, .of = name_of(kind)});
  return proportional(rows.values, expected);
}

/// The mistakes that explain a wrong number. `all_off`: all are off by one; `zero`: it has weight
/// 0.
std::vector<Diagnosis> signs_of_pick(double u, double index, const std::vector<double>& cdf,
                                     bool all_off, bool zero) {
  if (all_off) return {next_number};
  if (!(index >= 0 && index < number(cdf.size()))) return {};
  if (u == cdf[static_cast<std::size_t>(index)]) return {edge_to_lower};
  return zero ? std::vector{zero_drawn} : std::vector<Diagnosis>{};
}

void judge_picks(Weights kind) {
  const std::vector<double> weights = weights_of(kind), cdf = exact_cdf(weights);
  const std::vector<double> u = numbers_for(weights);
  const std::string name = name_of(kind);
  const Rows rows = probe("Lab 5.4 picks", params_of(kind),
                          {.rows = u.size(), .columns = 2, .finite = false, .of = name});
  const bool all_off = draws_next_number(u, rows, cdf);
  double worst = 0;
  bool below_one = true, up_to_one = true, all_spent = true, all_raw = true, all_zero = true;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Place place = place_of(u[i], cdf);
    const double index = rows.at(i, 0), fraction = rows.at(i, 1);
    const bool valid = index >= 0 && index < number(weights.size()) && std::floor(index) == index;
    const bool zero = valid && weights[static_cast<std::size_t>(index)] == 0;
    const bool decided = exact_edges(kind) || !near_edge(u[i], cdf);
    if (!valid || zero || (decided && index != place.index)) {
      std::vector<Diagnosis> signs = signs_of_pick(u[i], index, cdf, all_off, zero);
      if (kind == Weights::rare && !all_off) {
        if (probabilities_by_float())
          signs = {float_cdf};
        else if (draws_by_float(u, rows, cdf))
          signs = {float_u};
      }
      if (draws_uniformly(u, rows, weights.size()))
        signs = {weights_not_used};
      else if (proportional(kind))
        signs = {sums_not_divided};
      judge(holds(fmt::format("the number drawn from {} with u = {:.17g}", name, u[i]), false,
                  fmt::format("{:g}", index), fmt::format("{:g}", place.index), signs));
      return;
    }
    below_one = below_one && fraction >= 0 && fraction < 1;
    up_to_one = up_to_one && fraction >= 0 && fraction <= 1;
    if (!decided) continue;
    const double slack = 1e-9 + 1e-15 / (cdf[static_cast<std::size_t>(index)] - place.before);
    const double distance = std::abs(fraction - place.fraction);
    worst = std::max(worst, distance <= slack ? 0 : std::isnan(distance) ? 1 : distance);
    all_spent = all_spent && fraction == u[i];
    all_zero = all_zero && fraction == 0;
    all_raw = all_raw && std::abs(fraction - (u[i] - place.before)) <= 1e-15;
  }
  judge(holds("the numbers drawn from " + name, true, "right", "right"));
  const bool of_next = fractions_of_next_number(u, rows, cdf);
  judge(holds("fractions of " + name, below_one,
              below_one ? "all in [0, 1)" : "some outside [0, 1)", "all in [0, 1)",
              up_to_one ? std::vector{fraction_of_one}
              : of_next ? std::vector{next_number}
                        : std::vector<Diagnosis>{}));
  Verdict verdict = equals("the largest error of a fraction, " + name, worst, 0, 0);
  if (!verdict.passed && all_spent) verdict.diagnoses.push_back(spent);
  if (!verdict.passed && all_zero && weights.size() > 1)
    verdict.diagnoses.push_back(fraction_missing);
  if (!verdict.passed && all_raw) verdict.diagnoses.push_back(not_stretched);
  if (!verdict.passed && of_next) verdict.diagnoses.push_back(next_number);
  judge(verdict);
}

/// True if these are the probabilities of the neighbours, all on the same side. Values at the ends
/// do not matter.
bool of_next_number(const std::vector<double>& found, const std::vector<double>& expected) {
  if (expected.size() < 3) return false;
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
  return std::equal(found.begin() + 1, found.end() - 1, expected.begin(), same) ||
         std::equal(found.begin() + 1, found.end() - 1, expected.begin() + 2, same);
}

/// True if the probabilities of 1e7 equal weights have the errors of sums in float: most of them,
/// and by less than a few times their size.
bool drifts(const std::vector<double>& found) {
  const auto off = [](double p) { return std::abs(p - 1e-7) > 1e-10 && std::abs(p) < 1e-6; };
  const auto [least, most] = std::minmax_element(found.begin(), found.end());
  return *most > *least * (1 + 1e-6) && 2 * std::count_if(found.begin(), found.end(), off) >
                                            static_cast<std::ptrdiff_t>(found.size());
}

}  // namespace

TEST_CASE("Lab 5.4: the number drawn is where u falls, and weight 0 is never drawn",
          "[lab05][ex4]") {
  for (int kind = 0; kind < static_cast<int>(Weights::count); ++kind)
    judge_picks(static_cast<Weights>(kind));
}

TEST_CASE("Lab 5.4: probabilities are the weights' shares", "[lab05][ex4]") {
  for (const Weights kind :
       {Weights::eighths, Weights::gaps, Weights::rugged, Weights::tiny, Weights::rare}) {
    const std::vector<double> expected = probabilities(weights_of(kind));
    const Rows rows = probe("Lab 5.4 probabilities", params_of(kind),
                            {.rows = expected.size(), .finite = false, .of = name_of(kind)});
    const std::vector<double> cdf = exact_cdf(weights_of(kind));
    const bool sums = std::equal(cdf.begin(), cdf.end(), rows.values.begin(),
                                 [](double a, double b) { return std::abs(a - b) <= 1e-9; });
    std::vector<Diagnosis> diagnoses;
    if (sums) diagnoses.push_back(cumulative);
    if (proportional(rows.values, expected)) diagnoses.push_back(sums_not_divided);
    const auto equal = [&](double p) { return std::abs(p * number(expected.size()) - 1) <= 1e-9; };
    if (std::all_of(rows.values.begin(), rows.values.end(), equal))
      diagnoses.push_back(weights_not_used);
    if (of_next_number(rows.values, expected)) diagnoses.push_back(next_number);
    if (kind == Weights::rare && diagnoses.empty() && probabilities_by_float())
      diagnoses.push_back(float_cdf);
    judge(all_equal(fmt::format("the probabilities of {}", name_of(kind)), rows.values, expected,
                    1e-14, diagnoses));
  }
}

// The sums' rounding may shift an edge by 1e-9 at worst, 0.01 of a share; in float the last sum of
// 1e7 weights of 0.1 is 1087937, not 1000000.
TEST_CASE("Lab 5.4: ten million weights keep their probabilities", "[lab05][ex4]") {
  constexpr std::int64_t n = 10'000'000, stride = 9973;
  constexpr std::size_t count = (n + stride - 1) / stride + 1;
  const Rows rows = probe("Lab 5.4 many weights", {.n = n, .numbers = {{"stride", stride}}},
                          {.rows = count, .columns = 2, .of = "1e7 equal weights"});
  std::vector<double> drawn;
  for (std::int64_t i = 0; i < n; i += stride)
    drawn.push_back(static_cast<double>(i));
  drawn.push_back(n - 1);
  const std::vector<Diagnosis> diagnoses =
      drifts(column(rows, 1)) ? std::vector{float_cdf} : std::vector<Diagnosis>{};
  judge(all_equal("the number drawn from the middle of its share", column(rows, 0), drawn, 0,
                  diagnoses));
  const std::vector<double> expected(count, 1e-7);
  judge(all_equal("the probability of one of 1e7", column(rows, 1), expected, 1e-15, diagnoses));
}

TEST_CASE("Lab 5.4: bad weights are refused", "[lab05][ex4]") {
  for (int kind = 0; kind < bad_weight_kinds; ++kind)
    judge_refusal("Lab 5.4 refusal", bad_weights_name(kind), kind);
}

// A sum in long double, or of weights made smaller first, does not overflow.
TEST_CASE("Lab 5.4: weights whose sum overflows are refused, or have their shares",
          "[lab05][ex4]") {
  const std::vector<double> weights = huge_weights(), expected = probabilities(weights);
  const Rows rows = probe(
      "Lab 5.4 huge weights", {},
      {.columns = 1 + weights.size(), .finite = false, .of = "the weights 1.5e308 0.5e308 1e308"});
  const double answer = rows.at(0, 0);
  bool shares = answer == 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    shares = shares && std::abs(rows.at(0, 1 + i) - expected[i]) <= 1e-14;
  judge(
      is_so("weights whose sum is above the largest double", answer == 1 || shares,
            answer == 0 ? "other probabilities than their shares" : "an exception of another kind",
            "carlo::Error, or their shares", {sum_overflows}));
}

TEST_CASE("Lab 5.4: random u give each number its share, and a fraction that is uniform",
          "[lab05][ex4]") {
  constexpr std::size_t n = 400'000;
  Params params = params_of(Weights::rugged);
  params.n = n;
  const Rows rows =
      probe("Lab 5.4 samples", params, {.rows = n, .columns = 2, .of = name_of(Weights::rugged)});
  const std::vector<double> expected = probabilities(weights_of(Weights::rugged));
  std::vector<double> counts(expected.size());
  for (const double index : column(rows, 0)) {
    if (index >= 0 && index < number(counts.size())) counts[static_cast<std::size_t>(index)] += 1;
  }
  judge(counts_are("how often each number is drawn", counts, expected, n,
                   {"number", 0, number(counts.size())}));
  judge(uniform_on("the fractions", column(rows, 1), 0, 1));
}
