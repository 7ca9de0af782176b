// Checks of exercise 9.6. The only random inputs follow from the probe's seed.

#include "09_bias/progressive_data.h"
#include "grader/judge/judge.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace lab09_progressive {

using namespace carlo::grader;

namespace {

const Diagnosis radius_late{"radius-one-pass-late",
                            "each pass has the radius of the one before it: the first has "
                            "first_radius, the second a smaller one already."};
const Diagnosis radius_shrinks_as_square{
    "square-not-rooted", "the radius shrinks by the factor that belongs to its square."};
const Diagnosis radius_grows{"radius-grows", "the factor is inverted: the radius grows."};
const Diagnosis pass_before{"pass-off-by-one",
                            "the factor is that of the pass before or after: pass is the one that "
                            "had this radius, and the first is 1."};
const Diagnosis alpha_missing{"alpha-missing",
                              "alpha is missing: pass/(pass + 1) is the factor for alpha = 0."};
const Diagnosis alpha_reversed{"one-minus-alpha",
                               "1 - alpha is used instead of alpha: with alpha near 1 the radius "
                               "shrinks slowly."};
const Diagnosis square_returned{"square-returned", "the radius's square is returned."};
const Diagnosis first_factor_always{"factor-of-the-first-pass",
                                    "the square shrinks by the same factor after every pass: that "
                                    "is exponential, and far too fast."};
const Diagnosis floats_drift{"radius-in-float",
                             "digits of the radius are lost in a float: over many passes it "
                             "drifts."};
const Diagnosis radius_stays{"radius-stays", "every pass gets the first radius."};
const Diagnosis shrunk_first{"first-radius-shrunk",
                             "the first pass gets a radius that has shrunk already."};
const Diagnosis radius_from_first{"shrunk-from-first-radius",
                                  "every radius is computed from the first one by one factor; it "
                                  "should follow from the previous one."};
const Diagnosis passes_from_zero{"passes-from-0", "the first pass is number 1, not 0."};
const Diagnosis one_pass_number{"pass-stays", "estimate() gets the same pass every time."};
const Diagnosis pass_backwards{"passes-backwards", "the last pass comes first."};
const Diagnosis called_twice{"called-more-than-once",
                             "estimate() is called more than once a pass."};
const Diagnosis one_too_few{"one-pass-too-few", "the last pass is left out."};
const Diagnosis one_too_many{"one-pass-too-many", "there is one pass too many."};
const Diagnosis sum_returned{"sum-not-mean", "the sum is returned, not the mean."};
const Diagnosis last_returned{"last-pass-only", "the last pass is returned, not the mean."};
const Diagnosis first_left_out{"first-pass-left-out", "the first pass is not in the mean."};
const Diagnosis halves{"mean-of-the-last-two",
                       "each pass is averaged with all before, half and half: old passes are "
                       "forgotten."};
const Diagnosis weighed{
    "weighed-by-area",
    "passes are weighted by the area of their discs; the mean has equal weights."};
const Diagnosis float_sum{
    "sum-in-float", "the sum is a float, which small summands no longer change once it is large."};

double shrinking(double pass, double alpha) {
  return (pass + alpha) / (pass + 1);
}

bool near_to(double is, double should, double tolerance) {
  return std::abs(is - should) <= tolerance * std::abs(should);
}

/// A mistake in the next radius.
struct RadiusSlip {
  Diagnosis diagnosis;
  std::function<double(const ProgressivePass&)> radius;
};

std::vector<RadiusSlip> radius_slips() {
  const auto rooted = [](double radius, double factor) { return radius * std::sqrt(factor); };
  return {
      {radius_shrinks_as_square,
       [](const ProgressivePass& p) { return p.radius * shrinking(p.pass, p.alpha); }},
      {radius_grows,
       [=](const ProgressivePass& p) { return rooted(p.radius, 1 / shrinking(p.pass, p.alpha)); }},
      {pass_before,
       [=](const ProgressivePass& p) { return rooted(p.radius, shrinking(p.pass - 1, p.alpha)); }},
      {pass_before,
       [=](const ProgressivePass& p) { return rooted(p.radius, shrinking(p.pass + 1, p.alpha)); }},
      {alpha_missing,
       [=](const ProgressivePass& p) { return rooted(p.radius, shrinking(p.pass, 0)); }},
      {alpha_reversed,
       [=](const ProgressivePass& p) { return rooted(p.radius, shrinking(p.pass, 1 - p.alpha)); }},
      {square_returned,
       [](const ProgressivePass& p) { return p.radius * p.radius * shrinking(p.pass, p.alpha); }},
      {first_factor_always,
       [=](const ProgressivePass& p) { return rooted(p.radius, shrinking(1, p.alpha)); }},
      {first_factor_always, [=](const ProgressivePass& p) { return rooted(p.radius, p.alpha); }}};
}

/// The radius of pass `pass`.
double radius_of(const ProgressiveRun& run, std::int64_t pass) {
  const auto n = static_cast<double>(pass);
  const double square =
      std::lgamma(n + run.alpha) - std::lgamma(1 + run.alpha) - std::lgamma(n + 1);
  return run.first_radius * std::exp(square / 2);
}

}  // namespace

TEST_CASE("Lab 9.6: the next radius", "[lab09][ex6]") {
  const std::size_t asked = drawn_passes(0).size();
  const Answer rows = probe("Lab 9.6 next radius", {},
                            {.rows = asked, .columns = 1, .finite = false, .of = "single passes"});
  const std::vector<ProgressivePass> passes = drawn_passes(rows.seed);
  const std::size_t extreme = asked - 2;  // the first of them
  constexpr double tolerance = 1e-9;
  std::vector<Diagnosis> found;
  for (const RadiusSlip& slip : radius_slips()) {
    bool all = true;
    for (std::size_t i = 0; i < extreme; ++i)
      all = all && near_to(rows.values[i], slip.radius(passes[i]), tolerance);
    if (all) found.push_back(slip.diagnosis);
  }
  bool right = true, as_float = true;
  for (std::size_t i = 0; i < asked; ++i) {
    const auto& [radius, pass, alpha] = passes[i];
    const double expected = radius * std::sqrt(shrinking(pass, alpha));
    const bool same = near_to(rows.values[i], expected, tolerance);
    as_float = as_float && (i >= extreme || near_to(rows.values[i], expected, 1e-6));
    right = right && (i >= extreme || same);
    std::vector<Diagnosis> told = found;
    if (found.empty() && !right && as_float) told = {floats_drift};
    // The squares of 1e-30 and 1e30 do not fit into a float.
    if (right) told = {floats_drift};
    judge(holds(fmt::format("the radius after pass {}, of radius {:.6g}, alpha = {:.4g}", pass,
                            radius, alpha),
                same, fmt::format("{:.12g}", rows.values[i]), fmt::format("{:.12g}", expected),
                told));
  }
}

TEST_CASE("Lab 9.6: the radius after a hundred thousand passes", "[lab09][ex6]") {
  constexpr std::int64_t passes = 100'000;
  const Answer rows = probe("Lab 9.6 many passes", {.n = passes},
                            {.rows = 1, .columns = 1, .finite = false, .of = "many passes"});
  const ProgressiveRun run = drawn_run(rows.seed);
  const double is = rows.values[0], expected = radius_of(run, passes + 1);
  const double n = passes;
  const auto along = [&](double power) {
    return run.first_radius * std::pow(expected / run.first_radius, power);
  };
  std::vector<Diagnosis> found;
  if (near_to(is, along(2), 1e-6)) found = {radius_shrinks_as_square};
  if (near_to(is, along(-1), 1e-6)) found = {radius_grows};
  if (near_to(is, radius_of({run.first_radius, 0}, passes + 1), 1e-6)) found = {alpha_missing};
  if (near_to(is, radius_of({run.first_radius, 1 - run.alpha}, passes + 1), 1e-6))
    found = {alpha_reversed};
  if (near_to(is, expected * std::sqrt(run.alpha / shrinking(n, run.alpha)), 1e-6) ||
      near_to(is, expected * std::sqrt(shrinking(n + 1, run.alpha) / shrinking(1, run.alpha)),
              1e-6))
    found = {pass_before};
  // A float's rounding errors add up, or cancel.
  if (near_to(is, expected, 0.02)) found = {floats_drift};
  judge(holds("the radius after 100 000 passes, a quotient of gamma functions",
              near_to(is, expected, 1e-8), fmt::format("{:.12g}", is),
              fmt::format("{:.12g}", expected), found));
}

namespace {

/// The calls of progressive_mean(), and its result.
struct ProgressiveAnswer {
  ProgressiveRun run;
  std::uint64_t seed;
  std::vector<double> pass, radius;
  double asked;
  glm::dvec3 mean;
};

ProgressiveAnswer progressive_answer(std::int64_t passes) {
  const auto n = static_cast<std::size_t>(passes);
  const Answer rows = probe("Lab 9.6 mean", {.n = passes},
                            {.rows = n + 3,
                             .columns = 2,
                             .finite = false,
                             .of = fmt::format("the mean of {} passes", n)});
  ProgressiveAnswer answer{drawn_run(rows.seed),
                           rows.seed,
                           {},
                           {},
                           rows.at(n, 0),
                           {rows.at(n + 1, 0), rows.at(n + 1, 1), rows.at(n + 2, 0)}};
  for (std::size_t i = 0; i < n; ++i) {
    answer.pass.push_back(rows.at(i, 0));
    answer.radius.push_back(rows.at(i, 1));
  }
  return answer;
}

std::vector<Diagnosis> of_pass_numbers(const std::vector<double>& pass) {
  const std::size_t n = pass.size();
  if (pass[0] == 0 && (n == 1 || pass[1] == 1)) return {passes_from_zero};
  if (n > 1 && pass[0] == static_cast<double>(n) && pass[1] == static_cast<double>(n - 1))
    return {pass_backwards};
  if (n > 1 && pass[0] == pass[1] && pass.back() == pass[0]) return {one_pass_number};
  return {};
}

/// `all`: every pass's radius is radius(pass).
std::vector<Diagnosis> of_radii(const ProgressiveAnswer& answer) {
  const auto all = [&](const std::function<double(double pass)>& radius) {
    for (std::size_t i = 0; i < answer.radius.size(); ++i) {
      if (!near_to(answer.radius[i], radius(static_cast<double>(i + 1)), 1e-7)) return false;
    }
    return true;
  };
  const auto [bound_first, bound_alpha] = answer.run;
  const auto first = bound_first, alpha = bound_alpha;  // older clang cannot capture bindings
  const auto root = [alpha = alpha](double pass) { return std::sqrt(shrinking(pass, alpha)); };
  const auto chain = [&](double pass) {
    return radius_of(answer.run, static_cast<std::int64_t>(pass));
  };
  if (all([&](double) { return first; })) return {radius_stays};
  if (all([&](double pass) { return chain(std::max(pass - 1, 1.0)); })) return {radius_late};
  if (all([&](double pass) { return chain(pass) * root(pass); }) ||
      all([&](double pass) { return chain(pass) * std::sqrt(alpha); }))
    return {shrunk_first};
  if (all([&](double pass) { return first * root(pass); }) ||
      all([&](double pass) { return pass == 1 ? first : first * root(pass - 1); }))
    return {radius_from_first};
  if (all([&](double pass) { return chain(pass) * chain(pass) / first; }))
    return {radius_shrinks_as_square};
  if (all([&](double pass) { return first * first / chain(pass); })) return {radius_grows};
  if (all([&](double pass) { return radius_of({first, 0}, static_cast<std::int64_t>(pass)); }))
    return {alpha_missing};
  if (all([&](double pass) {
        return radius_of({first, 1 - alpha}, static_cast<std::int64_t>(pass));
      }))
    return {alpha_reversed};
  if (all([&](double pass) {
        return pass == 1 ? first : chain(pass) * std::sqrt(alpha) / root(pass - 1);
      }) ||
      all([&](double pass) { return pass == 1 ? first : chain(pass + 1) / root(1); }))
    return {pass_before};
  if (all([&](double pass) { return first * std::pow(root(1), pass - 1); }) ||
      all([&](double pass) { return first * std::pow(alpha, (pass - 1) / 2); }))
    return {first_factor_always};
  for (std::size_t i = 0; i < answer.radius.size(); ++i) {
    if (!near_to(answer.radius[i], chain(static_cast<double>(i + 1)), 1e-4)) return {};
  }
  return {floats_drift};
}

/// A possible wrong mean.
struct MeanSlip {
  Diagnosis diagnosis;
  glm::dvec3 mean;
};

std::vector<glm::dvec3> pass_radiances(const ProgressiveAnswer& answer) {
  carlo::Rng rng(answer.seed);
  std::vector<glm::dvec3> values;
  for (std::size_t i = 0; i < answer.pass.size(); ++i)
    values.emplace_back(pass_radiance(static_cast<int>(i + 1), rng));
  return values;
}

std::vector<MeanSlip> mean_slips(const ProgressiveAnswer& answer) {
  const std::vector<glm::dvec3> values = pass_radiances(answer);
  const auto n = static_cast<double>(values.size());
  glm::dvec3 sum(0), folded(values[0]), areas(0);
  double area_sum = 0;
  glm::vec3 floats(0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double radius = radius_of(answer.run, static_cast<std::int64_t>(i + 1));
    sum += values[i];
    floats += glm::vec3(values[i]);
    folded = (folded + values[i]) / 2.0;
    areas += radius * radius * values[i];
    area_sum += radius * radius;
  }
  return {{float_sum, glm::dvec3(floats) / n},
          {sum_returned, sum},
          {last_returned, values.back()},
          {first_left_out, (sum - values[0]) / (n - 1)},
          {first_left_out, (sum - values[0]) / n},
          {one_too_few, (sum - values.back()) / n},
          {one_too_few, (sum - values.back()) / (n - 1)},
          {halves, folded},
          {weighed, areas / area_sum}};
}

bool same_mean(glm::dvec3 is, glm::dvec3 should) {
  return near_to(is.r, should.r, 1e-6) && near_to(is.g, should.g, 1e-6) &&
         near_to(is.b, should.b, 1e-6);
}

void judge_progressive_mean(std::int64_t passes) {
  const ProgressiveAnswer answer = progressive_answer(passes);
  const std::string of = fmt::format(", of {}", passes);
  std::vector<Diagnosis> found;
  if (answer.asked == static_cast<double>(passes - 1)) found = {one_too_few};
  if (answer.asked == static_cast<double>(passes + 1)) found = {one_too_many};
  if (answer.asked == static_cast<double>(2 * passes)) found.push_back(called_twice);
  const bool count_is_right = answer.asked == static_cast<double>(passes);
  judge(holds("calls of estimate()" + of + " passes", count_is_right,
              fmt::format("{:g}", answer.asked), fmt::format("{}", passes), found));
  double wrong_pass = 0, wrong_radius = 0;
  std::string wrong_radii = "0";
  for (std::size_t i = 0; i < answer.pass.size(); ++i) {
    const auto pass = static_cast<std::int64_t>(i + 1);
    wrong_pass += answer.pass[i] == static_cast<double>(pass) ? 0 : 1;
    const double radius = radius_of(answer.run, pass);
    if (near_to(answer.radius[i], radius, 1e-8)) continue;
    if (wrong_radius++ == 0) {
      wrong_radii =
          fmt::format("; of pass {} it is {:.9g}, not {:.9g}", pass, answer.radius[i], radius);
    }
  }
  if (wrong_radius > 0) wrong_radii = fmt::format("{:g}", wrong_radius) + wrong_radii;
  // With too few or too many calls, passes, radii and the mean all differ.
  const auto unless_miscounted = [&](const std::vector<Diagnosis>& diagnoses) {
    return found.empty() ? diagnoses : found;
  };
  judge(holds("passes with a wrong number" + of, wrong_pass == 0, fmt::format("{:g}", wrong_pass),
              "0", unless_miscounted(of_pass_numbers(answer.pass))));
  judge(holds("passes with a wrong radius" + of, wrong_radius == 0, wrong_radii, "0",
              unless_miscounted(of_radii(answer))));
  const std::vector<MeanSlip> slips = mean_slips(answer);
  const glm::dvec3 expected = slips[1].mean / static_cast<double>(passes);
  std::vector<Diagnosis> told;
  for (const MeanSlip& slip : slips) {
    if (told.empty() && same_mean(answer.mean, slip.mean)) told = {slip.diagnosis};
  }
  const auto text = [](glm::dvec3 v) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.r, v.g, v.b);
  };
  judge(holds("the mean" + of + " passes", same_mean(answer.mean, expected), text(answer.mean),
              text(expected), unless_miscounted(told)));
}

}  // namespace

TEST_CASE("Lab 9.6: the mean over passes, each with its radius", "[lab09][ex6]") {
  judge_progressive_mean(1);
  judge_progressive_mean(5);
}

TEST_CASE("Lab 9.6: the mean of many passes", "[lab09][ex6]") {
  judge_progressive_mean(20'000);
}

}  // namespace lab09_progressive
