// Checks of exercises 5.7 and 5.8. For chi-square tests see checks_curves.cpp. The mean of 200 000
// counts of darts detects a shift of 8.74 sd / sqrt(n) with power .999: at an acceptance of 1/10
// (mean 10, sd 9.5) that is .19 darts, and leaving one dart out of the count is a shift of 1.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Unsaid unsaid{"kind", "target"};

constexpr double pi = std::numbers::pi;

const Diagnosis last_not_counted{"accepted-dart-not-counted",
                                 "the dart that is accepted counts as well."};
const Diagnosis only_y_redrawn{"x-kept-after-rejection",
                               "a rejected dart is discarded, with its x: keeping x and drawing "
                               "y again accepts every x eventually, and f no longer matters."};
const Diagnosis second_height{"second-height-for-a-dart",
                              "a dart above f is given a second height before it is discarded: a "
                              "rejected dart is over, and the next one has a new x."};
const Diagnosis same_number{"one-number-for-x-and-y",
                            "x and y come from one random number: the darts lie on a diagonal."};
const Diagnosis y_first{"y-drawn-before-x", "the contract asks for x first, then y."};
const Diagnosis bound_ignored{"bound-not-used",
                              "y has to be uniform on [0, f_max), not on [0, 1)."};
const Diagnosis bound_short{"heights-below-the-bound",
                            "too few darts miss: y has to be uniform on [0, f_max), all of it."};
const Diagnosis x_not_shifted{"interval-not-shifted", "x has to be uniform on [a, b)."};
const Diagnosis height_for_x{"height-for-x",
                             "the height of the dart is returned instead of its x."};
const Diagnosis above_accepted{"accepts-above-f",
                               "darts above f are kept and those below are thrown away."};
const Diagnosis promise_unchecked{"broken-bound-unnoticed",
                                  "f outside [0, f_max] silently distorts the density: it has to "
                                  "be an error."};
const Diagnosis endless{"never-gives-up", "a function that is 0 everywhere must not hang."};
const Diagnosis bound_missing{"acceptance-without-bound", "the rectangle's area is (b - a) f_max."};
const Diagnosis width_missing{"acceptance-without-width", "the rectangle's area is (b - a) f_max."};
const Diagnosis inverted{"acceptance-inverted",
                         "the mean number of darts is given, the inverse of the share accepted."};
const Diagnosis uniform_radius{
    "uniform-radius",
    "the distance itself is uniform: the points crowd at the centre, since an outer ring has "
    "more area than an inner one of the same width."};
const Diagnosis half_turn{"half-a-turn", "the angle runs over half a turn only."};
const Diagnosis degrees{
    "degrees-for-radians",
    "the angle is in degrees: sine and cosine take radians; a whole turn is 2 pi."};
const Diagnosis without_pi{"angle-without-pi",
                           "the angle lacks its factor: a whole turn is 2 pi, and u_angle runs "
                           "to 1."};
const Diagnosis sine_for_cosine{"sine-and-cosine-exchanged",
                                "the angle runs from the y axis, the wrong way round: sine and "
                                "cosine are exchanged."};
const Diagnosis exchanged{"u-exchanged", "u_radius and u_angle are exchanged."};
const Diagnosis quarter{"one-quadrant-only", "the darts cover one quarter of the square."};
const Diagnosis square_kept{"corners-kept", "points of the square outside the disc are returned."};
const Diagnosis by_circumference{"density-of-circumference",
                                 "the area of the unit disc is pi, not 2 pi."};

const char* name_of(Target target) {
  constexpr const char* names[] = {"x^2 on [-1, 2) under 10", "sin x on [0, pi) under 1",
                                   "a step at 1/2 under 3"};
  return names[static_cast<int>(target)];
}

/// The darts of independent trials with success probability p.
Theory geometric(double p) {
  return {1 / p, std::sqrt(1 - p) / p, 6 + p * p / (1 - p)};
}

/// Too few darts although none of them is left out of the count: without the accepted one there
/// would be samples of no dart at all.
bool too_few(const std::vector<double>& darts, double p) {
  double sum = 0;
  for (const double count : darts)
    sum += count;
  return std::count(darts.begin(), darts.end(), 0.0) == 0 &&
         sum * p < 0.98 * static_cast<double>(darts.size());
}

/// `fewer`: the mistakes that explain too few darts, if no suspect does.
void judge_darts(const std::string& what, const std::vector<double>& darts, double p,
                 Suspects suspects = {}, const std::vector<Diagnosis>& fewer = {}) {
  if (std::count(darts.begin(), darts.end(), 0.0) > 0)
    suspects.push_back({1 / p - 1, last_not_counted});
  Verdict mean = mean_is("the mean number of darts, " + what, darts, geometric(p), suspects);
  if (!mean.passed && mean.diagnoses.empty() && too_few(darts, p)) mean.diagnoses = fewer;
  judge(mean);
  judge(variance_is("the variance of the number of darts, " + what, darts, geometric(p)));
}

/// 500 samples of a function, each with its dart: x, darts, evaluations of f, numbers drawn, and
/// the dart's two numbers.
Rows record(Target target) {
  return probe("Lab 5.7 record", {.n = 500, .numbers = {{"target", static_cast<double>(target)}}},
               {.rows = 500, .columns = 6, .finite = false, .of = name_of(target)});
}

/// An answer without any number means that f was refused.
bool is_refusal(const Rows& rows) {
  return std::all_of(rows.values.begin(), rows.values.end(),
                     [](double value) { return std::isnan(value); });
}

Verdict not_refused(Target target) {
  return holds(fmt::format("samples of {}", name_of(target)), false, "carlo::Error",
               "numbers: it keeps within its bound");
}

/// Three numbers a rejected dart, and two or three for the one that is accepted.
bool has_second_heights(const Rows& rows) {
  bool all = true, at_first = false, at_second = false;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double darts = rows.at(i, 1), drawn = rows.at(i, 3);
    all = all && (drawn == 3 * darts || drawn == 3 * darts - 1);
    at_first = at_first || (drawn == 3 * darts - 1 && darts > 1);
    at_second = at_second || drawn == 3 * darts;
  }
  return all && at_first && at_second;
}

/// Two numbers make a dart, of which x is returned. If this fails, the samples' other properties
/// follow from that.
bool darts_are_whole() {
  const TargetCase c = target_case(Target::sine);
  const Rows rows = record(Target::sine);
  bool one_number = true, heights = true;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    one_number = one_number && rows.at(i, 3) == rows.at(i, 1);
    heights = heights && std::abs(rows.at(i, 0) - c.bound * rows.at(i, 5)) <= 1e-12;
  }
  return !one_number && !heights && !has_second_heights(rows);
}

/// The samples of one function, compared by x.
struct Samples {
  TargetCase c;
  Formula cdf;
  std::vector<double> x;

  static constexpr std::size_t cells = 100;

  Verdict fit(const std::string& what, const Formula& other) const {
    return counts_are(what, counted(x, c.a, c.b, cells), masses(other, c.a, c.b, cells),
                      static_cast<double>(x.size()), {"x", c.a, c.b});
  }
  bool uniform() const {
    return fit("", [this](double at) { return (at - c.a) / (c.b - c.a); }).passed;
  }
  /// Distributed like the part of the rectangle above f.
  bool like_above() const {
    const double area = (c.b - c.a) * c.bound;
    return fit("",
               [this, area](double at) {
                 return ((at - c.a) * c.bound - c.integral * cdf(at)) / (area - c.integral);
               })
        .passed;
  }
  /// On [0, b - a) instead of [a, b).
  bool not_shifted() const {
    const auto inside = [this](double at) { return at >= c.a && at < c.b; };
    const auto from_zero = [this](double at) { return at >= 0 && at < c.b - c.a; };
    return !std::all_of(x.begin(), x.end(), inside) && std::all_of(x.begin(), x.end(), from_zero);
  }
  /// The mistakes that were tested for samples that do not fit, and those found.
  void name_signs(Verdict& verdict) const {
    verdict.looked_for = {only_y_redrawn, above_accepted, x_not_shifted};
    if (uniform()) verdict.diagnoses.push_back(only_y_redrawn);
    if (like_above()) verdict.diagnoses.push_back(above_accepted);
    if (not_shifted()) verdict.diagnoses.push_back(x_not_shifted);
  }
};

/// x must be the accepted dart's first number.
void judge_x(const Rows& rows, const TargetCase& c) {
  std::vector<double> expected;
  bool from_second = true, heights = true, known = true;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double x = rows.at(i, 0), first = rows.at(i, 4), second = rows.at(i, 5);
    known = known && std::isfinite(first);
    expected.push_back(c.a + (c.b - c.a) * first);
    from_second = from_second && std::abs(c.a + (c.b - c.a) * second - x) <= 1e-12;
    heights = heights && std::abs(c.bound * second - x) <= 1e-12;
  }
  std::vector<Diagnosis> diagnoses;
  if (from_second) diagnoses.push_back(y_first);
  if (heights && !from_second) diagnoses.push_back(height_for_x);
  if (known) {
    judge(all_equal("x of the accepted dart, from its first number", column(rows, 0), expected,
                    1e-14, diagnoses));
  } else {
    judge(holds("the count of darts, of which the last is accepted", false, "none, or far too many",
                "1 at least"));
  }
}

void judge_record(Target target) {
  const Rows rows = record(target);
  if (is_refusal(rows)) return judge(not_refused(target));
  const std::vector<double> drawn = column(rows, 3), darts = column(rows, 1);
  std::vector<double> twice = darts;
  for (double& count : twice)
    count *= 2;
  const bool one_each = std::equal(drawn.begin(), drawn.end(), darts.begin());
  std::vector<Diagnosis> diagnoses;
  if (one_each) diagnoses = {same_number};
  if (has_second_heights(rows)) diagnoses = {second_height};
  judge(all_equal("the numbers drawn, two a dart", drawn, twice, 0, diagnoses));
  judge(all_equal("evaluations of f, one a dart", column(rows, 2), darts, 0));
  judge_x(rows, target_case(target));
}

}  // namespace

TEST_CASE("Lab 5.7: samples fill every cell by f's integral, whatever the bound", "[lab05][ex7]") {
  constexpr std::size_t n = 200'000;
  const bool whole_darts = darts_are_whole();
  for (int kind = 0; kind < static_cast<int>(Target::count); ++kind) {
    const auto target = static_cast<Target>(kind);
    const TargetCase c = target_case(target);
    const Rows rows = probe("Lab 5.7 samples", {.n = n, .numbers = {{"target", kind}}},
                            {.rows = n, .columns = 2, .finite = false, .of = name_of(target)});
    if (is_refusal(rows)) {
      judge(not_refused(target));
      continue;
    }
    const Samples samples{c, [=](double at) { return target_cdf(target, at); }, column(rows, 0)};
    Verdict verdict = samples.fit(fmt::format("samples of {}", name_of(target)), samples.cdf);
    if (!verdict.passed && whole_darts) samples.name_signs(verdict);
    const bool otherwise = !verdict.diagnoses.empty() || !whole_darts;
    const double p = c.integral / ((c.b - c.a) * c.bound);
    const std::vector<double> darts = column(rows, 1);
    if (!verdict.passed && !otherwise && c.bound == 1 && too_few(darts, p))
      verdict.diagnoses.push_back(bound_short);
    judge(verdict);
    Suspects suspects;
    if (c.bound != 1) suspects.push_back({(c.b - c.a) / c.below_one, bound_ignored});
    judge_darts(name_of(target), darts, p, suspects,
                otherwise ? std::vector<Diagnosis>{} : std::vector{bound_short});
  }
}

TEST_CASE("Lab 5.7: a dart is two fresh numbers, x first, and one look at f", "[lab05][ex7]") {
  for (int kind = 0; kind < static_cast<int>(Target::count); ++kind)
    judge_record(static_cast<Target>(kind));
}

TEST_CASE("Lab 5.7: f outside its promised range is an error, and so is a search in vain",
          "[lab05][ex7]") {
  constexpr const char* names[] = {"f = 1.5 under the bound 1", "f = -0.5", "f that is NaN",
                                   "f that is NaN above x = 1/2"};
  for (int kind = 0; kind < 4; ++kind) {
    const Rows rows =
        probe("Lab 5.7 broken promise", {.numbers = {{"kind", kind}}}, {.of = names[kind]});
    judge(is_so(names[kind], rows.at(0, 0) == 1,
                rows.at(0, 0) == 0 ? "accepted" : "an exception of another kind", "carlo::Error",
                {promise_unchecked}));
  }
  const Rows rows = probe("Lab 5.7 in vain", {}, {.columns = 2, .of = "f = 0 everywhere"});
  // A submission that accepts a dart at f = 0 does not search in vain.
  const bool searched = rows.at(0, 1) >= 1e7;
  judge(is_so("f = 0 everywhere", rows.at(0, 0) == 1, "no carlo::Error", "carlo::Error",
              searched ? std::vector{endless} : std::vector<Diagnosis>{}));
  judge(equals("the darts thrown in vain", rows.at(0, 1), 1e7, 0));
}

TEST_CASE("Lab 5.7: the acceptance rate is the share of the rectangle under f", "[lab05][ex7]") {
  const auto rate = [](double integral, double a, double b, double bound) {
    return probe("Lab 5.7 rate",
                 {.numbers = {{"integral", integral}, {"a", a}, {"b", b}, {"bound", bound}}}, {})
        .at(0, 0);
  };
  judge(equals("of x^2 on [-1, 2) under 5", rate(3, -1, 2, 5), 0.2, 1e-15,
               {{1, bound_missing}, {0.6, width_missing}, {5, inverted}}));
  judge(equals("of sin x on [0, pi) under 1", rate(2, 0, pi, 1), 2 / pi, 1e-15));
}

// 200 000 points; the Kolmogorov-Smirnov tests detect a distribution function that is off by .015
// anywhere with power .999.
TEST_CASE("Lab 5.8: darts leave points that are uniform on the disc", "[lab05][ex8]") {
  constexpr std::size_t n = 200'000;
  const Rows rows =
      probe("Lab 5.8 rejection", {.n = n}, {.rows = n, .columns = 5, .finite = false});
  std::vector<double> squares, angles, expected_x, expected_y;
  double outside = 0, negative = 0;
  bool swapped = true, diagonal = true;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = rows.at(i, 0), y = rows.at(i, 1);
    squares.push_back(x * x + y * y);
    angles.push_back(std::atan2(y, x));
    outside += squares.back() <= 1 ? 0 : 1;
    negative += x < 0 || y < 0 ? 1 : 0;
    expected_x.push_back(2 * rows.at(i, 3) - 1);
    expected_y.push_back(2 * rows.at(i, 4) - 1);
    swapped = swapped && x == expected_y.back() && y == expected_x.back();
    diagonal = diagonal && x == y;
  }
  judge(holds("points outside the disc", outside == 0, fmt::format("{:g} of {}", outside, n),
              "none", {square_kept}));
  Verdict turn = uniform_on("the angles", angles, -pi, pi);
  if (!turn.passed && negative == 0) turn.diagnoses.push_back(quarter);
  if (!turn.passed && diagonal) turn.diagnoses.push_back(same_number);
  judge(turn);
  judge(uniform_on("the squared distances", squares, 0, 1));
  judge_darts("the disc", column(rows, 2), pi / 4);
  std::vector<Diagnosis> diagnoses;
  if (swapped) diagnoses.push_back(y_first);
  if (negative == 0) diagnoses.push_back(quarter);
  if (diagonal) diagnoses.push_back(same_number);
  judge(all_equal("x, from the accepted dart's first number", column(rows, 0), expected_x, 1e-15,
                  diagnoses));
  judge(all_equal("y, from its second number", column(rows, 1), expected_y, 1e-15, diagnoses));
}

TEST_CASE("Lab 5.8: inversion puts the point where both numbers say", "[lab05][ex8]") {
  const std::size_t count = hard_numbers().size() * 7;
  const Rows rows =
      probe("Lab 5.8 inversion at", {}, {.rows = count, .columns = 4, .finite = false});
  struct Way {
    std::function<double(double, double)> radius, angle;
    Diagnosis diagnosis;
  };
  const auto root = [](double u, double) { return std::sqrt(u); };
  const auto turn = [](double, double v) { return 2 * pi * v; };
  const std::vector<Way> ways = {
      {root, turn, {}},
      {[](double u, double) { return u; }, turn, uniform_radius},
      {root, [](double, double v) { return pi * v; }, half_turn},
      {root, [](double, double v) { return 360 * v; }, degrees},
      {root, [](double, double v) { return 2 * v; }, without_pi},
      {root, [](double, double v) { return v; }, without_pi},
      {root, [](double, double v) { return pi / 2 - 2 * pi * v; }, sine_for_cosine},
      {[](double, double v) { return std::sqrt(v); }, [](double u, double) { return 2 * pi * u; },
       exchanged}};
  double wrong = 0;
  std::vector<double> misfits(ways.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double r = ways[w].radius(rows.at(i, 0), rows.at(i, 1));
      const double a = ways[w].angle(rows.at(i, 0), rows.at(i, 1));
      const double off =
          std::hypot(rows.at(i, 2) - r * std::cos(a), rows.at(i, 3) - r * std::sin(a));
      misfits[w] += off <= (w == 0 ? 1e-14 : 1e-12) ? 0 : 1;
    }
  }
  wrong = misfits[0];
  std::vector<Diagnosis> diagnoses;
  for (std::size_t w = 1; w < ways.size(); ++w) {
    if (misfits[w] == 0) diagnoses.push_back(ways[w].diagnosis);
  }
  judge(holds("points that are not where u_radius and u_angle put them", wrong == 0,
              fmt::format("{:g} of {}", wrong, count), "none", diagnoses));
}

TEST_CASE("Lab 5.8: inversion's points are uniform on the disc", "[lab05][ex8]") {
  constexpr std::size_t n = 200'000;
  const Rows rows = probe("Lab 5.8 inversion", {.n = n}, {.rows = n, .columns = 2});
  std::vector<double> squares, angles;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = rows.at(i, 0), y = rows.at(i, 1);
    squares.push_back(x * x + y * y);
    angles.push_back(std::atan2(y, x));
  }
  judge(uniform_on("the squared distances", squares, 0, 1));
  judge(uniform_on("the angles", angles, -pi, pi));
}

TEST_CASE("Lab 5.8: the density is 1 over the area, and 0 outside", "[lab05][ex8]") {
  const auto density = [](double x, double y) {
    return probe("Lab 5.8 density", {.numbers = {{"x", x}, {"y", y}}}, {}).at(0, 0);
  };
  const Suspects suspects{{1 / (2 * pi), by_circumference}};
  judge(equals("at the centre", density(0, 0), 1 / pi, 1e-15, suspects));
  judge(equals("at (0.6, -0.79)", density(0.6, -0.79), 1 / pi, 1e-15, suspects));
  judge(equals("at (0.6, -0.81)", density(0.6, -0.81), 0, 0));
  judge(equals("in the corner (-0.8, 0.8)", density(-0.8, 0.8), 0, 0));
}
