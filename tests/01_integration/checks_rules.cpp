// Checks of exercise 1.4. A rule's error for the first power that it does not integrate is
// known exactly (h: the cell's width): for x^2, midpoint -(b - a) h^2 / 12 and trapezoid
// +(b - a) h^2 / 6; for x^4, Simpson +(b - a) h^4 / 120.

#include "01_integration/drawn.h"
#include "01_integration/integrands.h"
#include "01_integration/slips.h"
#include "01_integration/theory.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

enum Rule { midpoint, trapezoid, simpson };
constexpr std::array<const char*, 3> names{"midpoint", "trapezoid", "Simpson"};

const Diagnosis ends_not_halved{"trapezoid-ends-not-halved",
                                "the two ends of the interval have full weight; each belongs to "
                                "one cell only and has half."};
const Diagnosis weights_swapped{"simpson-weights-swapped",
                                "the weights 4 (midpoints) and 2 (inner joints) are swapped."};
const Diagnosis wrong_factor{"simpson-wrong-factor",
                             "Simpson's weighted sum has the wrong factor: for a function that "
                             "is 1 everywhere the result must be b - a."};
const Diagnosis no_midpoints{
    "simpson-without-midpoints",
    "f is evaluated n + 1 times: here each of the n cells has its own parabola through its ends "
    "and its midpoint, which takes 2 n + 1."};
const Diagnosis one_too_many{"one-round-too-many",
                             "one evaluation too many: a loop runs one round too far, up to the "
                             "interval's end."};
const Diagnosis joints_twice{"joints-evaluated-twice",
                             "f is evaluated twice where two cells meet: once is enough, with the "
                             "weight of both."};
const Diagnosis at_left_ends{"midpoint-at-cell-ends",
                             "f is evaluated at the cells' ends and not in their middle."};
const Diagnosis drift{"step-accumulated",
                      "the points drift from where they should be: adding h repeatedly "
                      "accumulates rounding errors; compute each point from its index."};
const Diagnosis wrong_rule_points{"wrong-points", "f is not evaluated at the points of the rule."};
const Diagnosis cell_width_missing{"missing-cell-width",
                                   "the sum is not multiplied by the width h."};
struct RuleInterval {
  double a, b;
};

Params rule_params(Rule rule, int k, RuleInterval on, std::int64_t n) {
  return {.n = n, .numbers = {{"rule", rule}, {"k", k}, {"a", on.a}, {"b", on.b}, {"points", 0}}};
}

/// The number of evaluations that the contract allows.
double evaluations(Rule rule, double n) {
  if (rule == midpoint) return n;
  return rule == trapezoid ? n + 1 : 2 * n + 1;
}

/// The rule's points, in order.
std::vector<double> points_of(Rule rule, RuleInterval on, int n) {
  std::vector<double> points;
  const int steps = rule == trapezoid ? n : 2 * n;
  for (int i = rule == midpoint ? 1 : 0; i <= steps; i += rule == midpoint ? 2 : 1) {
    points.push_back(on.a + (on.b - on.a) * i / steps);
  }
  return points;
}

/// The rule's result for f with the weights of its inner points (at joints and at midpoints) and of
/// its ends, in units of h: {1, 4, 2} / 6 is Simpson's.
template <class F>
double weighted(const F& f, RuleInterval on, int n, double end, double middle, double joint) {
  const double h = (on.b - on.a) / n;
  double sum = end * (f(on.a) + f(on.b));
  for (int i = 0; i < n; ++i)
    sum += middle * f(on.a + (i + 0.5) * h);
  for (int i = 1; i < n; ++i)
    sum += joint * f(on.a + i * h);
  return h * sum;
}

/// The effect of mistakes on the number of evaluations.
Suspects count_suspects(Rule rule, double n) {
  Suspects list;
  if (n != 2)
    list.push_back({evaluations(rule, n) + 1, one_too_many});  // for 2 the same as
                                                               // joints_twice
  if (rule == simpson && n > 1) list.push_back({n + 1, no_midpoints});
  if (rule == trapezoid && n > 2) list.push_back({2 * n, joints_twice});
  if (rule == simpson && n > 2) list.push_back({3 * n, joints_twice});
  return list;
}

/// True if all points are ends of the interval where they should not be: i/n in whole numbers is 0,
/// and so is a width h that is a multiple of 1/n.
bool all_at_ends(std::span<const double> points, RuleInterval on, int n) {
  return n > 1 && std::all_of(points.begin(), points.end(), [on](double x) {
           return std::abs(x - on.a) <= 1e-12 || std::abs(x - on.b) <= 1e-12;
         });
}

/// The results of each rule's mistakes for f, when it is evaluated as often as it should be.
template <class F>
Suspects suspects(Rule rule, const F& f, RuleInterval on, int n, double right) {
  Suspects list{{right * n / (on.b - on.a), cell_width_missing}};
  if (rule == midpoint) {
    const double h = (on.b - on.a) / n;
    const double ends = weighted(f, on, n, 0, 0, 1);
    list.push_back({ends + h * f(on.a), at_left_ends});
    list.push_back({ends + h * f(on.b), at_left_ends});
  } else if (rule == trapezoid) {
    list.push_back({weighted(f, on, n, 1, 0, 1), ends_not_halved});
  } else {
    list.push_back({weighted(f, on, n, 1.0 / 6, 2.0 / 6, 4.0 / 6), weights_swapped});
    // The factor should be h/6, or half the step over 3: also try other thirds, halves and sixths.
    for (const double factor : {0.5, 1.5, 2.0, 3.0})
      list.push_back({factor * right, wrong_factor});
  }
  return list;
}

/// The rule's result for f.
template <class F>
double by_rule(Rule rule, const F& f, RuleInterval on, int n) {
  if (rule == midpoint) return weighted(f, on, n, 0, 1, 0);
  return rule == trapezoid ? weighted(f, on, n, 0.5, 0, 1)
                           : weighted(f, on, n, 1.0 / 6, 4.0 / 6, 2.0 / 6);
}

/// The rule's error for x^k, k up to 2 (midpoint, trapezoid) or 4 (Simpson).
double exact_error(Rule rule, int k, RuleInterval on, int n) {
  const double width = on.b - on.a;
  const double h = width / n;
  if (rule == simpson) return k == 4 ? width * std::pow(h, 4) / 120 : 0;
  if (k < 2) return 0;
  return rule == midpoint ? -width * h * h / 12 : width * h * h / 6;
}

void judge_rule(Rule rule) {
  for (const RuleInterval on : {RuleInterval{1, 3}, RuleInterval{-1.5, 0.5}}) {
    for (const int n : {1, 2, 7}) {
      for (int k = 0; k <= (rule == simpson ? 4 : 2); ++k) {
        const std::string what =
            fmt::format("{}: x^{} over [{}, {}], n = {}", names[rule], k, on.a, on.b, n);
        const Rows rows =
            probe("Lab 1.4 rule", rule_params(rule, k, on, n), {.columns = 3, .of = what});
        const double right =
            (on.b - on.a) * power_mean(k, on.a, on.b) + exact_error(rule, k, on, n);
        const bool counted = rows.at(0, 1) == evaluations(rule, n);
        const auto f = [k](double x) { return power(x, k); };
        judge(equals(what, rows.at(0, 0), right, 1e-12 * 100,
                     counted ? suspects(rule, f, on, n, right) : Suspects{}));
      }
    }
  }
}

/// Judges the value for a function and an interval that are not known beforehand.
void judge_drawn(Rule rule) {
  for (const int n : {1, 2, 5, 12}) {
    const std::string what = fmt::format("{}: a random wave, n = {}", names[rule], n);
    const Answer rows =
        probe("Lab 1.4 drawn wave", {.n = n, .numbers = {{"rule", rule}}}, {.of = what});
    const DrawnWave wave = drawn_wave(rows.seed, 1);
    const RuleInterval on{wave.lower[0], wave.upper[0]};
    const auto f = [&](double x) { return wave(std::span(&x, 1)); };
    const double right = by_rule(rule, f, on, n);
    judge(equals(what, rows.at(0, 0), right, 1e-11, suspects(rule, f, on, n, right)));
  }
}

/// The known mistake that explains the positions of the points, in order, if there is one.
std::optional<Diagnosis> sign_of(Rule rule, std::span<const double> points, RuleInterval on,
                                 int n) {
  if (all_at_ends(points, on, n)) return whole_division;
  const double half = (on.b - on.a) / n / 2, off = std::abs(points[0] - on.a - half);
  if (rule == midpoint && std::abs(off - half) <= 1e-12) return at_left_ends;
  return std::nullopt;
}

/// Returns the mistake that explains the points. `inherited`: that of the earlier rules, which this
/// one may be built on.
std::optional<Diagnosis> judge_points(Rule rule, const std::optional<Diagnosis>& inherited = {}) {
  std::optional<Diagnosis> seen;
  for (const int n : {1, 2, 7}) {
    const RuleInterval on{-1, 2.5};
    Params params = rule_params(rule, 1, on, n);
    const std::vector<double> expected = points_of(rule, on, n);
    params.numbers["points"] = static_cast<double>(expected.size());
    const Rows count = probe("Lab 1.4 rule", params,
                             {.columns = 3, .of = fmt::format("{}, n = {}", names[rule], n)});
    judge(equals(fmt::format("{}: evaluations for n = {}", names[rule], n), count.at(0, 1),
                 evaluations(rule, n), 0, count_suspects(rule, n)));
    if (count.at(0, 1) != evaluations(rule, n)) continue;  // its points do not match the list
    const Rows rows = probe("Lab 1.4 points", params,
                            {.rows = expected.size(),
                             .finite = false,
                             .of = fmt::format("{} over [-1, 2.5], n = {}", names[rule], n)});
    std::optional<Diagnosis> sign = sign_of(rule, rows.values, on, n);
    if (!sign) sign = inherited;
    Verdict verdict = all_equal(fmt::format("{}: the points for n = {}", names[rule], n),
                                rows.values, expected, 1e-12, {sign.value_or(wrong_rule_points)});
    if (!verdict.passed && !seen) seen = sign;
    judge(verdict);
  }
  return seen;
}

/// The last point of a million cells on [0, 0.1] must be right to 1e-12 of the width.
void judge_last_point(Rule rule) {
  const std::int64_t n = 1'000'000;
  const RuleInterval on{0, 0.1};
  const Rows rows = probe("Lab 1.4 rule", rule_params(rule, 1, on, n),
                          {.columns = 3, .of = fmt::format("{}, n = 1e6", names[rule])});
  const double last = rule == midpoint ? 0.1 - 0.1 / 2e6 : 0.1;
  judge(equals(fmt::format("{}: evaluations for n = 1e6", names[rule]), rows.at(0, 1),
               evaluations(rule, 1e6), 0));
  Verdict verdict =
      equals(fmt::format("{}: the last point", names[rule]), rows.at(0, 2), last, 1e-13);
  const bool near = std::abs(rows.at(0, 2) - last) <= 1e-9;
  if (!verdict.passed && near) verdict.diagnoses.push_back(drift);
  judge(verdict);
}

}  // namespace

TEST_CASE("Lab 1.4: each rule evaluates f where it should, once", "[lab01][ex4]") {
  const std::optional<Diagnosis> of_midpoint = judge_points(midpoint);
  const std::optional<Diagnosis> of_trapezoid = judge_points(trapezoid);
  judge_points(simpson, of_midpoint ? of_midpoint : of_trapezoid);
}

TEST_CASE("Lab 1.4: the midpoint rule is exact for lines and has its known error for x^2",
          "[lab01][ex4]") {
  judge_rule(midpoint);
}

TEST_CASE("Lab 1.4: the trapezoid rule is exact for lines and has its known error for x^2",
          "[lab01][ex4]") {
  judge_rule(trapezoid);
}

TEST_CASE("Lab 1.4: Simpson's rule is exact for cubics and has its known error for x^4",
          "[lab01][ex4]") {
  judge_rule(simpson);
}

TEST_CASE("Lab 1.4: functions and intervals that nobody knows by heart", "[lab01][ex4]") {
  for (const Rule rule : {midpoint, trapezoid, simpson})
    judge_drawn(rule);
}

TEST_CASE("Lab 1.4: a million cells do not drift", "[lab01][ex4]") {
  for (const Rule rule : {midpoint, trapezoid, simpson})
    judge_last_point(rule);
}

TEST_CASE("Lab 1.4: an empty interval gives 0", "[lab01][ex4]") {
  for (const Rule rule : {midpoint, trapezoid, simpson}) {
    const Rows rows = probe("Lab 1.4 rule", rule_params(rule, 2, {3, 3}, 4),
                            {.columns = 3, .of = fmt::format("{} over [3, 3]", names[rule])});
    judge(equals(fmt::format("{}: the integral over [3, 3]", names[rule]), rows.at(0, 0), 0, 0));
  }
}
