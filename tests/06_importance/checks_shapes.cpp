// Checks of exercises 6.3 and 6.4. Where inputs are given numbers, the outputs are compared with
// closed forms. One comparison is statistical: Hill's estimate on exact Pareto numbers.

#include "06_importance/inputs.h"
#include "06_importance/match.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace carlo::grader;
using namespace lab06_tests;

namespace {

const Diagnosis lower_end_ignored{"starts-at-the-foot",
                                  "the angles run from atan(a/height), not from 0."};
const Diagnosis uniform_points{"uniform-along-the-ray",
                               "t is uniform on [a, b]: it is the angle that has to be."};
const Diagnosis angle_density{"density-of-the-angle",
                              "1/(B - A) is the density of the angle; the density of t is that "
                              "times d angle/dt = height/(height^2 + t^2)."};
const Diagnosis not_normalised{"pdf-not-normalised",
                               "the pdf does not integrate to 1: divide by the integral of "
                               "1/(height^2 + t^2) over [a, b]."};
const Diagnosis not_zero_outside{"pdf-not-zero-outside", "outside [a, b] the pdf is 0."};
const Diagnosis leaves_interval{
    "sample-leaves-the-interval",
    "rounding moves the last sample out of [a, b], where the pdf is 0."};
const Diagnosis falling_samples{"samples-run-backwards", "sample(u) has to grow with u."};

double angle(const Light& light) {
  return std::atan(light.b / light.height) - std::atan(light.a / light.height);
}

std::string name_of(const Light& light) {
  return fmt::format("height {:g}, [{:g}, {:g}]", light.height, light.a, light.b);
}

Params light_params(std::size_t i, std::int64_t n = 0) {
  return {.n = n, .numbers = {{"light", static_cast<double>(i)}}};
}

/// The value of `formula` at each of `at`.
std::vector<double> values_of(const std::function<double(double)>& formula,
                              const std::vector<double>& at) {
  std::vector<double> values;
  values.reserve(at.size());
  for (const double x : at)
    values.push_back(formula(x));
  return values;
}

std::function<std::string(std::size_t)> labels(const char* symbol, const std::vector<double>& at) {
  return [=](std::size_t i) { return fmt::format("at {} = {:.17g}", symbol, at[i]); };
}

/// f = 1/(height^2 + t^2) over the pdf is the same at every point: zero variance. t has an error of
/// a few ulp of its angle, which the tolerances allow for.
void judge_samples(std::size_t index) {
  const Light light = lights().at(index);
  const std::size_t count = hard_numbers().size();
  const Rows rows = probe("Lab 6.3 samples", light_params(index),
                          {.rows = count + 1, .columns = 3, .finite = false, .of = name_of(light)});
  std::vector<double> u = hard_numbers(), t = column(rows, 1), pdf = column(rows, 2);
  t.pop_back();
  pdf.pop_back();
  const double first = std::atan(light.a / light.height);
  const double size = std::max({light.height, std::abs(light.a), std::abs(light.b)});
  const std::vector<Alternative> others = {
      {values_of([&](double v) { return light.a + (light.b - light.a) * v; }, u), uniform_points},
      {values_of([&](double v) { return light.height * std::tan(angle(light) * v); }, u),
       lower_end_ignored},
      {values_of(
           [&](double v) { return light.height * std::tan(std::atan(light.b / light.height) * v); },
           u),
       lower_end_ignored},
      {values_of([&](double v) { return light.height * std::tan(first + angle(light) * (1 - v)); },
                 u),
       falling_samples}};
  judge(all_match(
      fmt::format("the sample for {}", name_of(light)), labels("u", u), t,
      values_of([&](double v) { return light.height * std::tan(first + angle(light) * v); }, u),
      1e-9, 1e-11 * size, others));
  const bool inside =
      std::all_of(t.begin(), t.end(), [&](double x) { return x >= light.a && x <= light.b; });
  judge(holds(fmt::format("samples for {}", name_of(light)), inside,
              fmt::format("from {:.17g} to {:.17g}", *std::min_element(t.begin(), t.end()),
                          *std::max_element(t.begin(), t.end())),
              "all within [a, b]", {leaves_interval}));
  std::vector<double> contributions;
  for (std::size_t i = 0; i < t.size(); ++i)
    contributions.push_back(1 / (light.height * light.height + t[i] * t[i]) / pdf[i]);
  const std::vector<double> constant(t.size(), angle(light) / light.height);
  judge(all_match(fmt::format("f/p of f = 1/(height^2 + t^2) for {}", name_of(light)),
                  labels("u", u), contributions, constant, 1e-10, 0));
  judge(holds(fmt::format("the pdf outside of {}", name_of(light)),
              rows.at(count, 1) == 0 && rows.at(count, 2) == 0,
              fmt::format("{:g} and {:g}", rows.at(count, 1), rows.at(count, 2)), "0 at both sides",
              {not_zero_outside}));
}

void judge_pdf(std::size_t index) {
  const Light light = lights().at(index);
  constexpr std::size_t n = 400;
  const Rows rows = probe("Lab 6.3 pdf", light_params(index, n),
                          {.rows = n, .columns = 2, .finite = false, .of = name_of(light)});
  const std::vector<double> t = column(rows, 0);
  const auto shape = [&](double x) { return 1 / (light.height * light.height + x * x); };
  const std::vector<Alternative> others = {
      {values_of([&](double) { return 1 / angle(light); }, t), angle_density},
      {values_of([&](double x) { return shape(x) / angle(light); }, t), not_normalised},
      {values_of([&](double x) { return light.height * shape(x); }, t), not_normalised},
      {values_of(shape, t), not_normalised},
      {values_of([&](double) { return 1 / (light.b - light.a); }, t), uniform_points}};
  judge(all_match(fmt::format("the pdf for {}", name_of(light)), labels("t", t), column(rows, 1),
                  values_of([&](double x) { return light.height * shape(x) / angle(light); }, t),
                  1e-10, 0, others));
}

const Diagnosis signed_values{
    "sign-not-dropped", "use absolute values: a large negative contribution is large as well."};
const Diagnosis share_of_mean{"largest-over-mean",
                              "the largest value is compared with the sum, not with the mean."};
const Diagnosis zeros_divided{"zero-by-zero", "where all values are 0 the share is 0."};
const Diagnosis reference_off{"reference-is-the-k-th-largest",
                              "the k largest are compared with the next one, m_k: counted from 0 "
                              "the k largest are m_0 to m_(k-1)."};
const Diagnosis inverse_index{"index-upside-down",
                              "the mean of the logarithms is 1/a; the index is its inverse."};
const Diagnosis not_sorted{"list-not-sorted", "the values have to be sorted in descending order."};
const Diagnosis no_tail{"no-tail-is-infinite",
                        "where the sizes do not differ, or are 0 at m_k, the index is infinite."};
const Diagnosis decimal_logs{"logarithm-to-base-10", "the index needs natural logarithms."};

/// The lists of inputs.h that are used for the largest share and the index.
std::string name_of(List list) {
  switch (list) {
    case List::mixed:
      return "2 4 4 4 5 5 7 9";
    case List::tail:
      return "powers of 2 with signs";
    case List::one:
      return "a single value";
    case List::equal:
      return "ten times 2.5";
    case List::sparse:
      return "three numbers among zeros";
    default:
      return "zeros";
  }
}

double share_probe(List list) {
  return probe("Lab 6.4 share", {.numbers = {{"list", static_cast<double>(list)}}},
               {.finite = false, .of = name_of(list)})
      .at(0, 0);
}

double index_probe(List list, int k) {
  return probe("Lab 6.4 index", {.numbers = {{"list", static_cast<double>(list)}, {"k", k}}},
               {.finite = false, .of = fmt::format("{}, k = {}", name_of(list), k)})
      .at(0, 0);
}

/// The powers of 2 from 256 to 1/2: m_i = 2^(8 - i), so log(m_i / m_k) = (k - i) log 2.
void judge_index(int k) {
  const double index = 2 / ((k + 1) * std::log(2.0));
  Suspects suspects{{1 / index, inverse_index}, {index * std::log(10.0), decimal_logs}};
  if (k > 1) suspects.push_back({2.0 * k / (k * (k - 1) * std::log(2.0)), reference_off});
  // The list as it is, and its positive numbers alone.
  const std::vector<double> list = list_of(List::tail);
  std::vector<double> positive = list;
  std::sort(positive.begin(), positive.end(), std::greater<>());
  double unsorted = 0, signless = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(k); ++i) {
    unsorted += std::log(std::abs(list[i] / list[static_cast<std::size_t>(k)]));
    signless += std::log(positive[i] / positive[static_cast<std::size_t>(k)]);
  }
  suspects.push_back({k / unsorted, not_sorted});
  suspects.push_back({k / signless, signed_values});
  judge(equals(fmt::format("the index of powers of 2, k = {}", k), index_probe(List::tail, k),
               index, 1e-13, suspects));
}

const Diagnosis number_reused{"same-number-for-both-decisions",
                              "u was used to choose one of the two: its remainder has to be "
                              "rescaled to [0, 1)."};
const Diagnosis roles_exchanged{"share-is-the-other-ones",
                                "p is drawn with probability share, q with 1 - share."};
const Diagnosis not_restarted{"second-part-not-shifted",
                              "q must get (u - share)/(1 - share): its part begins at share."};
const Diagnosis reaches_one{
    "number-of-one", "a number is rounded to 1: below_one() of densities.h is there for it."};
const Diagnosis pdf_unweighted{"mixture-pdf-unweighted",
                               "the pdf is share p + (1 - share) q, not the sum of both."};
const Diagnosis pdf_exchanged{"mixture-pdf-exchanged",
                              "in the pdf share belongs to p and 1 - share to q."};
const Diagnosis pdf_of_one{
    "mixture-pdf-of-one-part",
    "a point may have come from either of the two: the pdf includes both, wherever the point lies."};

const Diagnosis pdf_maximum{"mixture-pdf-maximum",
                            "this is the larger of the two: a point may have come from either, "
                            "and their probabilities add up."};

void judge_mixture_samples(std::size_t index, const Rows& rows) {
  const double s = shares().at(index);
  const std::vector<double> u = numbers_for(s);
  // Encodes in one number which of the two was called and with which number: q's numbers get 2
  // added.
  std::vector<double> asked;
  for (std::size_t i = 0; i < u.size(); ++i)
    asked.push_back(2 * rows.at(i, 1) + rows.at(i, 2));
  const auto with = [&](const std::function<double(double)>& x) { return values_of(x, u); };
  const std::vector<Alternative> others = {
      {with([&](double v) { return v < s ? v : 2 + v; }), number_reused},
      {with([&](double v) { return v < s ? v / s : 2 + v / (1 - s); }), not_restarted},
      {with([&](double v) { return v < s ? v / s : 2 + v; }), not_restarted},
      {with([&](double v) { return v < s ? v / s : 2 + v - s; }), not_restarted},
      {with([&](double v) { return v < 1 - s ? v / (1 - s) : 2 + (v - (1 - s)) / s; }),
       roles_exchanged},
      {with([&](double v) { return v < s ? 2 + v / s : (v - s) / (1 - s); }), roles_exchanged}};
  judge(all_match(fmt::format("p's number, or 2 + q's number, for share {:g}", s), labels("u", u),
                  asked, with([&](double v) { return v < s ? v / s : 2 + (v - s) / (1 - s); }),
                  1e-14, 1e-15, others));
  const std::vector<double> numbers = column(rows, 2);
  const double largest = *std::max_element(numbers.begin(), numbers.end());
  judge(holds(fmt::format("the largest number handed on for share {:g}", s), largest < 1,
              fmt::format("{:.17g}", largest), "below 1",
              largest == 1 ? std::vector{reaches_one} : std::vector<Diagnosis>{}));
}

void judge_mixture_pdf(std::size_t index, const Rows& rows) {
  const double s = shares().at(index);
  std::vector<double> at, measured;
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    for (std::size_t i = 0; i < rows.count(); ++i) {
      at.push_back(side == 0 ? rows.at(i, 0) : -rows.at(i, 0));
      measured.push_back(rows.at(i, 3 + side));
    }
  }
  const auto mixed = [&](double p_share, double q_share) {
    return values_of(
        [=](double x) { return p_share * positive_pdf(x) + q_share * negative_pdf(x); }, at);
  };
  std::vector<Alternative> others = {{mixed(1, 1), pdf_unweighted},
                                     {mixed(0.5, 0.5), pdf_unweighted},
                                     {mixed(1, 0), pdf_of_one},
                                     {mixed(0, 1), pdf_of_one}};
  const auto of_both = [&](const Diagnosis& diagnosis, const auto& value) {
    for (const double weight : {1.0, s}) {
      const double rest = weight == 1 ? 1 : 1 - s;
      const auto pdf = [&](double x) {
        return value(x, weight * positive_pdf(x), rest * negative_pdf(x));
      };
      others.push_back({values_of(pdf, at), diagnosis});
    }
  };
  of_both(pdf_maximum, [](double, double p, double q) { return std::max(p, q); });
  // The pdf if share were a position on the line, not a probability.
  of_both(pdf_of_one, [&](double x, double p, double q) { return x < s ? p : q; });
  if (s != 0.5) others.push_back({mixed(1 - s, s), pdf_exchanged});
  judge(all_match(fmt::format("the pdf for share {:g}", s), labels("x", at), measured,
                  mixed(s, 1 - s), 1e-14, 1e-15, others));
}

}  // namespace

TEST_CASE("Lab 6.3: equal steps of u are equal angles", "[lab06][ex3]") {
  for (std::size_t i = 0; i < lights().size(); ++i)
    judge_samples(i);
}

TEST_CASE("Lab 6.3: the pdf is the light's share", "[lab06][ex3]") {
  for (std::size_t i = 0; i < lights().size(); ++i)
    judge_pdf(i);
}

TEST_CASE("Lab 6.4: the largest value's share of the sum", "[lab06][ex4]") {
  judge(equals("of 2 4 4 4 5 5 7 9", share_probe(List::mixed), 9.0 / 40, 1e-15,
               {{9.0 / 5, share_of_mean}}));
  judge(equals("of powers of 2 with signs", share_probe(List::tail), 256 / 511.5, 1e-15,
               {{256 / 314.5, signed_values}, {256 / 51.15, share_of_mean}}));
  judge(equals("of a single value", share_probe(List::one), 1, 0, {{0, signed_values}}));
  judge(holds("of zeros", share_probe(List::zeros) == 0,
              fmt::format("{:g}", share_probe(List::zeros)), "0", {zeros_divided}));
}

TEST_CASE("Lab 6.4: the index of a list that is known", "[lab06][ex4]") {
  for (const int k : {1, 2, 5, 9})
    judge_index(k);
}

TEST_CASE("Lab 6.4: where there is no tail the index is infinite", "[lab06][ex4]") {
  const bool inverted = index_probe(List::equal, 3) == 0;
  const auto infinite = [=](const std::string& what, List list, int k) {
    const double index = index_probe(list, k);
    judge(holds(what, index == infinity, fmt::format("{:g}", index), "infinity",
                {index == 0 && inverted ? inverse_index : no_tail}));
  };
  infinite("ten times 2.5, k = 3", List::equal, 3);
  infinite("zeros, k = 2", List::zeros, 2);
  infinite("three numbers among zeros, k = 3", List::sparse, 3);
  judge(equals("three numbers among zeros, k = 2", index_probe(List::sparse, 2),
               2 / (std::log(8.0 / 2) + std::log(4.0 / 2)), 1e-14));
}

// For Pareto numbers the k logarithms are independent exponentials (Renyi), so 1/estimate is the
// mean of k of them: mean 1/a, sd 1/(a sqrt(k)), excess kurtosis 6/k. 2000 lists with k = 40: a
// bias of 3.1 % is detected with power .999; taking m_(k-1) as reference gives one of 1/k = 2.5 %,
// which the lists above distinguish.
TEST_CASE("Lab 6.4: on Pareto numbers the index is right on average", "[lab06][ex4]") {
  for (const double a : {1.5, 4.0}) {
    constexpr std::size_t lists = 2000;
    const Rows rows = probe("Lab 6.4 pareto",
                            {.n = 400, .numbers = {{"a", a}, {"k", 40}, {"repetitions", lists}}},
                            {.rows = lists});
    judge(mean_is(fmt::format("1/index for Pareto numbers of index {:g}", a), rows.values,
                  {1 / a, 1 / (a * std::sqrt(40.0)), 6.0 / 40}, {{a, inverse_index}}));
  }
}

TEST_CASE("Lab 6.4: a mixture draws from both with what is left of u", "[lab06][ex4]") {
  for (std::size_t i = 0; i < shares().size(); ++i) {
    const std::size_t count = numbers_for(shares().at(i)).size();
    const Rows rows = probe("Lab 6.4 mixture", {.numbers = {{"share", static_cast<double>(i)}}},
                            {.rows = count,
                             .columns = 5,
                             .finite = false,
                             .of = fmt::format("share {}", shares().at(i))});
    judge_mixture_samples(i, rows);
    judge_mixture_pdf(i, rows);
  }
}
