// Checks of exercise 9.3, feature_weight(). Everything has an exact answer, computed in double from
// the numbers that the probe drew; the rounding that the contract allows is below 1e-5.

#include "09_bias/feature_theory.h"
#include "grader/judge/judge.h"

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace carlo::grader;

namespace lab09_features {
namespace {

const Diagnosis half_lost{"half-lost",
                          "squared distances have to be divided by twice the "
                          "strength's square."};
const Diagnosis not_squared{"distance-not-squared",
                            "distances count squared: |a - a'|^2 over 2 strength^2."};
const Diagnosis strength_not_squared{"strength-not-squared",
                                     "a strength is a distance: divide the squared distance by "
                                     "its square."};
const Diagnosis features_averaged{"features-averaged",
                                  "only colours are averaged over the channels; for a feature "
                                  "use the squared length of the difference."};
const Diagnosis cosine_of_normals{"one-minus-cosine",
                                  "1 - n . n' is half of |n - n'|^2, and has to be halved once "
                                  "more."};
const Diagnosis depth_absolute{"depth-not-relative",
                               "the difference of depths is relative to the larger one: "
                               "otherwise the filter depends on the scene's scale."};
const Diagnosis depth_of_one{"depth-over-own-depth",
                             "divide by the larger of both depths; with the pixel's own depth "
                             "the weight is not symmetric."};
const Diagnosis depth_of_smaller{"depth-over-smaller", "the larger of both depths divides."};
const Diagnosis depth_of_mean{"depth-over-mean",
                              "the larger of both depths divides, not the mean."};
const Diagnosis sky_not_defined{"sky-beside-sky",
                                "two pixels that see the sky have depth 0: 0/0 is no number."};
const Diagnosis noise_counted{"noise-as-difference",
                              "subtract the expected difference of two estimates of one colour, "
                              "v, first."};
const Diagnosis weight_above_one{"below-noise-rewarded",
                                 "colours that differ by less than their noise count as equal, "
                                 "not as more than equal: max(0, ...)."};
const Diagnosis variance_of_one{"variance-of-one",
                                "both colours are noisy: the variance of their difference is the "
                                "sum of both."};
const Diagnosis larger_variance{"larger-variance",
                                "the variance of a difference is the sum of both, not the larger."};
const Diagnosis errors_added{"standard-errors-added", "variances add, standard errors do not."};
const Diagnosis root_of_variance{"variance-as-standard-error",
                                 "a variance is already a square: do not square it again."};
const Diagnosis k_not_squared{"k-not-squared", "k is in standard errors: multiply v by k^2."};
const Diagnosis channels_summed{"channels-summed",
                                "the three channels' distances are averaged, not added up."};
const Diagnosis worst_channel{"largest-channel", "the mean of the three channels counts."};
const Diagnosis channels_mixed{"channels-mixed",
                               "channels are compared one by one: differences of different signs "
                               "must not cancel."};
const Diagnosis sure_not_defined{"sure-colours-not-defined",
                                 "if neither colour has a variance the term is 0/0: equal "
                                 "colours then add 0, different ones make the weight 0."};
const Diagnosis sure_ignored{"sure-colours-ignored",
                             "colours without noise that differ are different: the weight is 0."};
const Diagnosis sure_refused{"sure-colours-refused",
                             "equal colours are equal even if neither has a variance."};
const Diagnosis grows{"weight-grows", "the weight is exp(-d): it falls with the distance."};
const Diagnosis not_exponential{"weight-not-exponential", "the weight is exp(-d)."};
const Diagnosis term_missing{"term-missing", "this difference has no effect on the weight."};
const Diagnosis not_symmetric{"not-symmetric", "a weight is the same both ways round."};

/// The results of mistakes in exp(-d) for any exponent d.
Suspects general_slips(double d) {
  return {{std::exp(d), grows},
          {1 / (1 + d), not_exponential},
          {d, not_exponential},
          {std::max(0.0, 1 - d), not_exponential},
          {1, term_missing}};
}

/// The results of mistakes for a feature with squared distance `squared`.
Suspects feature_slips(double squared, double strength) {
  const double d = squared / (2 * strength * strength), length = std::sqrt(squared);
  Suspects slips{{std::exp(-2 * d), half_lost},
                 {std::exp(-length / (2 * strength * strength)), not_squared},
                 {std::exp(-length / strength), not_squared},
                 {std::exp(-length / (2 * strength)), not_squared},
                 {std::exp(-squared / (2 * strength)), strength_not_squared},
                 {std::exp(-squared / strength), strength_not_squared},
                 {std::exp(-d / 3), features_averaged}};
  const Suspects general = general_slips(d);
  slips.insert(slips.end(), general.begin(), general.end());
  return slips;
}

Suspects normal_slips(const Pair& p) {
  const double squared = apart2(p.one.normal, p.other.normal);
  Suspects slips = feature_slips(squared, p.strength.normal);
  slips.insert(slips.begin(), {std::exp(-squared / (4 * p.strength.normal * p.strength.normal)),
                               cosine_of_normals});
  return slips;
}

Suspects depth_slips(const Pair& p) {
  const double a = real(p.one.depth), b = real(p.other.depth), apart = a - b;
  const double two = 2 * p.strength.depth * p.strength.depth;
  // Even with the wrong divisor, a depth of 0 is still left out.
  const auto over = [&](double depth) {
    return depth == 0 ? 1 : std::exp(-apart * apart / (depth * depth * two));
  };
  Suspects slips{{std::exp(-apart * apart / two), depth_absolute},
                 {over(a), depth_of_one},
                 {over(b), depth_of_one},
                 {over(std::min(a, b)), depth_of_smaller},
                 {over(0.5 * (a + b)), depth_of_mean}};
  const double part = apart / std::max(a, b);
  const Suspects general = feature_slips(part * part, p.strength.depth);
  slips.insert(slips.end(), general.begin(), general.end());
  return slips;
}

Suspects color_slips(const Pair& p) {
  const double k = p.strength.color, k2 = k * k;
  const auto weight = [&](const auto& channel) { return std::exp(-color_sum(p, channel) / 3); };
  const auto beyond = [](double apart, double v) { return std::max(0.0, apart * apart - v); };
  double largest = 0, mixed = 0, mixed_v = 0;
  color_sum(p, [&](double apart, double v, double w) {
    largest = std::max(largest, beyond(apart, v + w) / (k2 * (v + w)));
    mixed += apart / 3, mixed_v += (v + w) / 3;
    return 0.0;
  });
  const auto with_v = [&](const auto& v_of) {
    return weight([&](double apart, double v, double w) {
      return beyond(apart, v_of(v, w)) / (k2 * v_of(v, w));
    });
  };
  const double right = color_term(p);
  Suspects slips{
      {weight([&](double apart, double v, double w) { return apart * apart / (k2 * (v + w)); }),
       noise_counted},
      {weight([&](double apart, double v, double w) {
         return (apart * apart - v - w) / (k2 * (v + w));
       }),
       weight_above_one},
      {with_v([](double v, double) { return v; }), variance_of_one},
      {with_v([](double, double w) { return w; }), variance_of_one},
      {with_v([](double v, double w) { return std::max(v, w); }), larger_variance},
      {with_v([](double v, double w) {
         const double errors = std::sqrt(v) + std::sqrt(w);
         return errors * errors;
       }),
       errors_added},
      {with_v([](double v, double w) { return v * v + w * w; }), root_of_variance},
      {with_v([](double v, double w) { return (v + w) * (v + w); }), root_of_variance},
      {with_v([](double v, double w) { return std::sqrt(v + w); }), errors_added},
      {std::exp(-right * k), k_not_squared},
      {std::exp(-3 * right), channels_summed},
      {std::exp(-largest), worst_channel},
      {std::exp(-beyond(mixed, mixed_v) / (k2 * mixed_v)), channels_mixed}};
  const Suspects general = general_slips(right);
  slips.insert(slips.end(), general.begin(), general.end());
  return slips;
}

Suspects slips_of(PairKind kind, const Pair& p) {
  switch (kind) {
    case albedo:
      return feature_slips(apart2(p.one.albedo, p.other.albedo), p.strength.albedo);
    case normal:
      return normal_slips(p);
    case depth:
    case sky:
      return depth_slips(p);
    case color:
    case noise:
    case one_sure:
      return color_slips(p);
    case both_sure:
      return {{1, sure_ignored}};
    case same_sure:
      return {{0, sure_refused}};
    case nothing:
    case no_depth:
    case everything:
    case pair_kinds:
      break;
  }
  return {};
}

const char* name_of(PairKind kind) {
  switch (kind) {
    case nothing:
      return "that differ in nothing but their variances";
    case albedo:
      return "of different albedo";
    case normal:
      return "of different normals";
    case depth:
      return "of different depth";
    case no_depth:
      return "that see the sky both";
    case sky:
      return "of which one sees the sky";
    case color:
      return "whose colours differ by more than their noise";
    case noise:
      return "whose colours differ by less than their noise";
    case one_sure:
      return "of which one has no noise";
    case both_sure:
      return "without noise whose colours differ";
    case same_sure:
      return "without noise of one colour";
    case everything:
    case pair_kinds:
      break;
  }
  return "that differ in everything a little";
}

/// The mistake that explains a NaN weight.
std::vector<Diagnosis> undefined(PairKind kind) {
  if (kind == no_depth) return {sky_not_defined};
  if (kind == both_sure || kind == same_sure) return {sure_not_defined};
  return {};
}

/// Judges the weight; true if it is right.
bool judge_weight(const std::string& what, double measured, double right, PairKind kind,
                  const Suspects& slips) {
  Verdict verdict = equals(what, measured, right, 1e-5, slips);
  if (!verdict.passed && std::isnan(measured)) verdict.diagnoses = undefined(kind);
  judge(verdict);
  return verdict.passed;
}

}  // namespace

TEST_CASE("Lab 9.3: how much one pixel weighs beside another", "[lab09][ex3]") {
  const Answer rows =
      probe("Lab 9.3 weights", {},
            {.rows = pair_kinds,
             .columns = 3,
             .finite = false,
             .of = fmt::format("{} pairs of pixels", static_cast<int>(pair_kinds))});
  const std::vector<Pair> pairs = drawn_pairs(rows.seed);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto kind = static_cast<PairKind>(i);
    const std::string of = fmt::format("the weight of pixels {}", name_of(kind));
    const double right = terms_of(pairs[i]).weight();
    const bool passed = judge_weight(of, rows.at(i, 0), right, kind, slips_of(kind, pairs[i]));
    Suspects back = slips_of(kind, pairs[i]);
    if (passed) back.insert(back.begin(), {rows.at(i, 1), not_symmetric});
    judge_weight(of + ", the other way round", rows.at(i, 1), right, kind, back);
    judge_weight(
        fmt::format("the weight of a pixel {} with itself", kind == no_depth ? "that sees the sky"
                                                            : kind == both_sure ? "without noise"
                                                                                : "with noise"),
        rows.at(i, 2), 1, kind, {});
  }
}

}  // namespace lab09_features
