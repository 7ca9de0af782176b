// Checks of exercise 8.4: worlds with closed forms, 50 000 paths each. The lecture's rule in a
// furnace of albedo 1/2 has infinite variance (the value is multiplied by 10 with probability 1/20
// each time), so a z test of its mean is meaningless: instead its possible values and their
// frequencies are tested.

#include "08_path_tracer/paths.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis gloss_forgotten{"gloss-forgotten",
                                "a light with a glossy lobe alone reflects as well: f_r is 0 only "
                                "where both kd and ks are."};
const Diagnosis another_p{
    "another-p-emit",
    "p_emit is 0.9 in the lecture's rule for each surface that both emits and reflects, not another "
    "number."};
const Diagnosis emission_not_divided{"emission-not-divided",
                                     "emission was chosen with probability p_emit: divide by it."};
const Diagnosis reflection_not_divided{"reflection-not-divided",
                                       "reflection was chosen with probability 1 - p_emit: divide "
                                       "by it."};
const Diagnosis mended_already{"lecture-rule-mended",
                               "emission and reflection are added: the lecture's rule, taken "
                               "literally, returns one of the two."};
const Diagnosis chances_swapped{"emission-and-reflection-swapped",
                                "emission is chosen with probability 1 - p_emit, and reflection "
                                "with p_emit: it should be the other way round."};
const Diagnosis still_the_lecture{"still-the-lectures-rule",
                                  "this is still the lecture's rule: emission always has to be "
                                  "added, and divided by nothing."};
const Diagnosis into_the_lecture{"recursion-into-the-lectures-rule",
                                 "the first surface is right; from the second on it is the "
                                 "lecture's rule: trace_path() has to call itself."};
const Diagnosis no_weight{"weight-missing",
                          "the radiance from sample()'s direction has to be multiplied by its "
                          "weight."};
const Diagnosis no_emission{"emission-missing", "the surfaces' emission is missing."};

}  // namespace

namespace {

/// The lecture's p_emit.
constexpr double p = 0.9;

/// What p_emit() gives for six surfaces.
std::vector<double> chances() {
  return probe("Lab 8.4 p_emit", {}, {.rows = 6}).values;
}

/// True if a surface that both emits and reflects has a chance, but another one.
bool has_another_p(const std::vector<double>& chances) {
  return chances[2] > 0 && chances[2] < 1 && std::abs(chances[2] - p) > 1e-6;
}

}  // namespace

TEST_CASE("Lab 8.4: p_emit is 0, 1 or 0.9", "[lab08][ex4]") {
  const std::vector<double> values = chances();
  std::vector<Diagnosis> diagnoses;
  if (has_another_p(values)) diagnoses = {another_p};
  if (std::abs(values[2] - p) <= 1e-6 && values[5] == 1) diagnoses = {gloss_forgotten};
  judge(
      all_equal("p_emit of a surface that reflects; emits; does both; in different channels; "
                "neither; emits and is glossy",
                values, std::vector{0.0, 1.0, p, p, 0.0, p}, 1e-6, diagnoses));
}

namespace {

/// True if more than 10 of the values are this one.
bool has(const std::vector<double>& values, double value) {
  return std::count_if(values.begin(), values.end(),
                       [&](double v) { return std::abs(v - value) < 1e-3 * value; }) > 10;
}

/// True if, in a furnace, emission has the probability, or the divisor, of reflection.
bool swapped(const std::vector<double>& values) {
  const auto first = std::count_if(values.begin(), values.end(),
                                   [](double v) { return std::abs(v * p - 1) < 1e-3; });
  const double share = static_cast<double>(first) / static_cast<double>(values.size());
  return first == 0 ? has(values, 1 / (1 - p)) && !has(values, 1)
                    : std::abs(share - (1 - p)) < 0.01;
}

/// True if about half of the rays that start on a surface, from the second bounce on, get lost:
/// then a furnace with albedo q rho has radiance 1/(1 - q rho). The first bounce is the same for
/// all paths.
bool loses_half(const Rows& rows) {
  double red = 0, green = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    red += rows.at(i, 0) / static_cast<double>(rows.count());
    green += rows.at(i, 1) / static_cast<double>(rows.count());
  }
  const auto share = [](double mean, double rho) { return (1 - rho / (mean - 1)) / rho; };
  const auto half = [](double q) { return q > 0.3 && q < 0.7; };
  return half(share(red, 0.5)) && half(share(green, 0.25));
}

/// True if, by the lecture's rule, emission is as frequent as it must be, but nothing comes from
/// beyond the surface.
bool nothing_from_beyond(const std::vector<double>& values) {
  const auto first = std::count_if(values.begin(), values.end(),
                                   [](double v) { return std::abs(v * p - 1) < 1e-3; });
  const double share = static_cast<double>(first) / static_cast<double>(values.size());
  return std::abs(share - p) < 0.01 && !has(values, 10 / p) && !has(values, 10);
}

std::vector<double> in_lectures_furnace() {
  return column(trace(lecture, furnace_of(0.5, 0.5)), 0);
}

/// The diagnosis of the corrected rule in a furnace.
std::vector<Diagnosis> of_mended(const Rows& rows) {
  const std::vector<double> red = column(rows, 0);
  if (has(red, 1 / p)) return {still_the_lecture};
  if (has(red, 1 + 1 / p)) return {into_the_lecture};
  if (ends_dark(red)) return {absorbed_dark};
  if (std::all_of(red.begin(), red.end(), [](double x) { return x == 1; })) {
    return {nothing_from_beyond(in_lectures_furnace()) ? self_hit : one_bounce};
  }
  if (loses_half(rows)) return {self_hit};
  return {};
}

/// The same for either rule: mistakes seen there affect other worlds, too.
std::vector<Diagnosis> seen_in_furnace(Method method) {
  if (method == mended) return of_mended(trace(mended, furnace_of(0.5, 0.25)));
  if (has_another_p(chances())) return {another_p};
  const std::vector<double> values = in_lectures_furnace();
  if (swapped(values)) return {chances_swapped};
  if (nothing_from_beyond(values)) return {self_hit};
  return {};
}

}  // namespace

TEST_CASE("Lab 8.4: the lecture's rule gives each value as often as it must", "[lab08][ex4]") {
  constexpr double rho = 0.5;
  const std::vector<double> values = column(trace(lecture, furnace_of(rho, rho)), 0);
  std::vector<double> none, first, second;
  double strange = 0;
  for (const double v : values) {
    const double steps = v > 0 ? std::log10(v * p) : 0;
    strange += std::abs(steps - std::round(steps)) <= 1e-4 && steps > -0.5 ? 0 : 1;
    none.push_back(v == 0 ? 1 : 0);
    first.push_back(v > 0 && std::abs(v * p - 1) < 1e-3 ? 1 : 0);
    second.push_back(std::abs(v * p - 10) < 1e-2 ? 1 : 0);
  }
  const auto bernoulli = [](double q) { return Theory{q, std::sqrt(q * (1 - q))}; };
  std::vector<Diagnosis> diagnoses;
  Suspects without_tens;
  const bool another = has_another_p(chances());
  if (another) {
    diagnoses.push_back(another_p);
  } else if (has(values, 1) && has(values, 2)) {
    diagnoses.push_back(mended_already);
  } else if (has(values, 1)) {
    diagnoses.push_back(emission_not_divided);
  } else if (swapped(values)) {
    diagnoses.push_back(chances_swapped);
  } else if (!has(values, 10 / p) && !has(values, 10) && !nothing_from_beyond(values)) {
    without_tens.push_back({0, reflection_not_divided});
  }
  judge(holds("values of the lecture's TracePath in a furnace", strange == 0,
              fmt::format("{:g} of {} are others", strange, paths), "0, 1/.9, 10/.9, 100/.9 ...",
              diagnoses));
  Verdict often = mean_is("how often it is 1/.9", first, bernoulli(p));
  if (!often.passed && !another && swapped(values)) often.diagnoses.push_back(chances_swapped);
  judge(often);
  judge(mean_is("how often it is 10/.9", second, bernoulli(p * (1 - p) * rho), without_tens));
  judge(mean_is("how often it is 0", none, bernoulli((1 - p) * (1 - rho) / (1 - (1 - p) * rho))));
}

TEST_CASE("Lab 8.4: mended, a furnace shows 1/(1 - albedo)", "[lab08][ex4]") {
  const Rows rows = trace(mended, furnace_of(0.5, 0.25));
  const std::vector<double> red = column(rows, 0);
  const std::vector<Diagnosis> values = of_mended(rows);
  for (const bool dark : {false, true}) {
    Verdict verdict = dark ? mean_is("radiance in a furnace of albedo .25", column(rows, 1),
                                     series(0.5, 0.5), {{1, one_bounce}, {2, no_weight}})
                           : mean_is("radiance in a furnace of albedo .5", red, series(0.5, 1),
                                     {{1, one_bounce}, {0, no_emission}});
    if (!verdict.passed && !values.empty()) verdict.diagnoses = values;
    judge(verdict);
  }
  const Theory exact = series(0.5, 1);
  // The number of bounces is geometric: its excess kurtosis is 6 + (1 - p)^2/p with p = 1/2.
  Verdict spread =
      variance_is("the variance in a furnace of albedo .5", red, {exact.mean, exact.sd, 6.5});
  if (!spread.passed) spread.diagnoses = values;
  judge(spread);
}

TEST_CASE("Lab 8.4: a light, and a ball under the sky", "[lab08][ex4]") {
  for (const Method method : {lecture, mended}) {
    const std::string name = method == lecture ? "by the lecture's rule, " : "mended, ";
    const double share = 0.5 * light_path_share;
    const auto judge_with = [&](Verdict verdict) {
      const std::vector<Diagnosis> seen =
          verdict.passed ? std::vector<Diagnosis>{} : seen_in_furnace(method);
      if (!seen.empty()) verdict.diagnoses = seen;
      judge(verdict);
    };
    judge_with(mean_is(name + "light from a light source",
                       column(trace(method, with(on_floor, {{"light", 0}})), 0),
                       {share, std::sqrt(share * (1 - share))}, {{0, self_hit}}));
    judge_with(mean_is(name + "a glossy ball under the sky",
                       column(trace(method, ball_of(glossy)), 0), ball_theory(),
                       {{0, sky_missing}}));
  }
}
