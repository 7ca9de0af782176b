// Checks of exercises 3.5 and 3.6: floats and whole numbers from words.

#include "03_rng/sequences.h"
#include "03_rng/words.h"
#include "grader/judge/compare.h"
#include "grader/judge/figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab03_tests;

namespace {

/// Chi-square test of counts against the expected ones (>= 100 each), at the level of one
/// comparison; too good a fit fails as well.
carlo::grader::Verdict chi_square_is(const std::string& what, const std::vector<double>& counts,
                                     const std::vector<double>& expected) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const auto freedom = static_cast<double>(counts.size() - 1);
  double count = 0;
  for (const double number : expected)
    count += number;
  carlo::grader::Verdict verdict = carlo::grader::chi_square_fits(what, statistic, freedom);
  verdict.effect = carlo::grader::effect_on_cells(statistic, freedom, count);
  if (!verdict.passed) verdict.figure = carlo::grader::counts_figure({}, counts, expected);
  return verdict;
}

constexpr std::int64_t tried = 50'000;
constexpr std::size_t all_tried = 50'000 + 2 * 4096;

const Diagnosis reaches_one{"float-reaches-one",
                            "the largest words give exactly 1: a float cannot hold 32 binary "
                            "digits and rounds up."};
const Diagnosis clamped{"clamped-below-one",
                        "the words that would round to 1 are clamped to the last float, which "
                        "then occurs too often; drop the digits before they are rounded."};
const Diagnosis digits_lost{"digits-lost",
                            "more of the word's digits are dropped than necessary: a float holds "
                            "24."};
const Diagnosis a_for_b{"lower-end-for-upper",
                        "where rounding reaches b, a is returned, the farthest value; the "
                        "nearest is the float below b."};
const Diagnosis reaches_b{"reaches-upper-end", "the upper end comes out: adding a rounds up to b."};
const Diagnosis overflow{"width-overflows", "b - a overflows in float when both are huge."};

std::vector<double> converted(const std::function<float(std::uint32_t)>& f) {
  std::vector<double> values;
  for (const std::uint32_t word : words_to_convert(tried))
    values.push_back(f(word));
  return values;
}

/// The distance between floats just below |x|'s power of two.
double gap(double x) {
  const float magnitude = static_cast<float>(std::abs(x));
  return static_cast<double>(magnitude) -
         std::nextafter(magnitude, -std::numeric_limits<float>::infinity());
}

void judge_between(float a, float b) {
  const std::string range = fmt::format("[{:.9g}, {:.9g})", a, b);
  const Rows rows = probe("Lab 3.5 between", {.n = tried, .numbers = {{"a", a}, {"b", b}}},
                          {.rows = all_tried, .finite = false, .of = range});
  const auto [low, high] = std::minmax_element(rows.values.begin(), rows.values.end());
  const bool finite = std::all_of(rows.values.begin(), rows.values.end(),
                                  [](double x) { return std::isfinite(x); });
  judge(holds("values in " + range, finite, finite ? "all finite" : "infinity or NaN", "all finite",
              {overflow}));
  std::vector<Diagnosis> end;
  if (*high == b) end.push_back(reaches_b);
  judge(holds("values in " + range, *low >= a && *high < b,
              fmt::format("from {:.9g} to {:.9g}", *low, *high), "all within " + range, end));
  const double wide_a = a, width = static_cast<double>(b) - wide_a;
  const double slack = 2 * gap(std::max(std::abs(wide_a), std::abs(static_cast<double>(b))));
  double worst = 0;
  bool only_a = true;  // every value that is far off is a where b would be near
  std::size_t i = 0;
  for (const std::uint32_t word : words_to_convert(tried)) {
    const double exact = wide_a + width * (static_cast<double>(word >> 8) * 0x1p-24);
    const double value = rows.values[i++];
    worst = std::max(worst, std::abs(value - exact));
    if (std::abs(value - exact) > slack) only_a = only_a && value == a && b - exact <= slack;
  }
  Verdict verdict = equals("the largest distance from a + (b - a) u in " + range, worst, 0, slack);
  const bool huge = width > std::numeric_limits<float>::max() && worst > width / 2;
  if (!verdict.passed && huge) verdict.diagnoses.push_back(overflow);
  if (!verdict.passed && only_a) verdict.diagnoses.push_back(a_for_b);
  judge(verdict);
}

const Diagnosis out_of_range{"integer-out-of-range", "numbers outside [u..v] are returned."};
const Diagnosis end_missing{"upper-end-missing",
                            "v itself never occurs: there are v - u + 1 values."};
const Diagnosis modulo{"modulo-bias",
                       "the low values occur too often: taking the remainder assigns the "
                       "left-over words to them."};
const Diagnosis division{"division-bias",
                         "some values, at even distances, occur too often: scaling still assigns "
                         "the left-over words to values."};
const Diagnosis through_float{"through-a-float",
                              "most values never occur: a float in [0, 1) has only 2^24 values."};
const Diagnosis count_overflows{"count-overflows",
                                "v - u + 1 is 2^32 for the widest range, which is 0 in 32 bits: "
                                "count the values in 64."};
const Diagnosis surplus_dealt{"surplus-word-dealt",
                              "one of the left-over words is used: is it < or <= at the limit?"};
const Diagnosis good_refused{"good-word-refused",
                             "one word too many is rejected: is it < or <= at the limit?"};
const Diagnosis draws_too_many{"draws-too-many-words",
                               "too many words are rejected: only the left-over ones need be."};

Rows integers(double u, double v, std::int64_t n) {
  return probe("Lab 3.6 integers", {.n = n, .numbers = {{"u", u}, {"v", v}}},
               {.rows = static_cast<std::size_t>(n), .columns = 2, .finite = false});
}

void judge_range(const Rows& rows, double u, double v) {
  const std::vector<double> values = column(rows, 0);
  const auto has = [&](auto property) {
    return std::any_of(values.begin(), values.end(), property);
  };
  const bool divides = has([](double x) { return std::isinf(x); });
  std::vector<Diagnosis> overflows;
  if (v - u + 1 >= 0x1p32) overflows.push_back(count_overflows);
  judge(holds(fmt::format("divisions for [{:.0f}..{:.0f}]", u, v), !divides,
              divides ? "by zero" : "fine", "by anything but zero", overflows));
  if (divides) return;
  const bool dry = has([](double x) { return std::isnan(x); });
  judge(holds("the words drawn", !dry, dry ? "more than 64 a number" : "few",
              "fewer than 2 a number", {draws_too_many}));
  if (dry) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  judge(holds(fmt::format("numbers in [{:.0f}..{:.0f}]", u, v), *low >= u && *high <= v,
              fmt::format("from {:.0f} to {:.0f}", *low, *high), "all within", {out_of_range}));
}

/// [u..v] with `values` values, for which 2^32 mod `values` words are left over; each value gets an
/// equal number of the others.
void judge_dealing(double values) {
  constexpr std::int64_t about = 2048;
  const double u = -2147483648.0, v = u + values - 1;
  const auto left_over = std::fmod(0x1p32, values);
  const double share = std::floor(0x1p32 / values);
  const Rows rows = probe("Lab 3.6 words dealt", {.n = about, .numbers = {{"u", u}, {"v", v}}},
                          {.rows = words_to_deal(about).size(), .finite = false});
  double refused = 0, most = 0;
  std::map<double, double> dealt;
  for (const double value : rows.values) {
    if (std::isnan(value)) {
      ++refused;
    } else {
      most = std::max(most, ++dealt[value]);
    }
  }
  const std::string range = fmt::format("[{:.0f}..{:.0f}]", u, v);
  std::vector<Diagnosis> one_more, one_fewer;
  if (refused == left_over + 1) one_more.push_back(good_refused);
  if (refused == left_over - 1) one_fewer.push_back(surplus_dealt);
  judge(holds(fmt::format("words refused for {}, of those tried", range), refused <= left_over,
              fmt::format("{:.0f}", refused), fmt::format("{:.0f} at most", left_over), one_more));
  judge(holds(fmt::format("words that give the same number of {}", range), most <= share,
              fmt::format("{:.0f}", most), fmt::format("{:.0f} at most", share), one_fewer));
}

std::vector<double> indicator(const std::vector<double>& values,
                              const std::function<bool(double)>& f) {
  std::vector<double> result;
  for (const double value : values)
    result.push_back(f(value) ? 1 : 0);
  return result;
}

double words_a_number(const Rows& rows) {
  double drawn = 0;
  for (const double words : column(rows, 1))
    drawn += words;
  return drawn / static_cast<double>(rows.count());
}

/// The rate of values with a property that a fraction `p` of [u..v] has.
Verdict share_is(const std::string& what, const std::vector<double>& indicators, double p,
                 const Suspects& suspects) {
  return mean_is(what, indicators, {.mean = p, .sd = std::sqrt(p * (1 - p))}, suspects);
}

}  // namespace

TEST_CASE("Lab 3.5: unit_float gives the multiples of 2^-24 below 1, 256 words each",
          "[lab03][ex5]") {
  const Rows rows = probe("Lab 3.5 unit", {.n = tried}, {.rows = all_tried});
  const auto scaled = [](std::uint32_t w) { return static_cast<float>(w) * 0x1p-32f; };
  const float last = std::nextafter(1.0f, 0.0f);
  std::vector<Diagnosis> one;
  const double highest = *std::max_element(rows.values.begin(), rows.values.end());
  if (highest == 1) one.push_back(reaches_one);
  judge(holds("the largest float", highest < 1, fmt::format("{:.9g}", highest), "below 1", one));
  judge(sequence_is(
      "the floats of 58 192 words", rows.values,
      converted([](std::uint32_t w) { return static_cast<float>(w >> 8) * 0x1p-24f; }),
      {{converted([&](std::uint32_t w) { return std::min(scaled(w), last); }), clamped},
       {converted(scaled), reaches_one},
       {converted([](std::uint32_t w) { return float(w >> 9) * 0x1p-23f; }), digits_lost},
       {converted([](std::uint32_t w) { return float(w >> 16) * 0x1p-16f; }), digits_lost}}));
}

TEST_CASE("Lab 3.5: float_between stays in [a, b) and close to a + (b - a) u", "[lab03][ex5]") {
  judge_between(0, 1);
  judge_between(-1, 1);
  judge_between(-5.25f, -2.5f);
  judge_between(1e-3f, 1e3f);
}

// u = 1 - 2^-24 in [1, 2): the sum lies half-way between the last float and 2, and the tie goes
// to 2.
TEST_CASE("Lab 3.5: float_between never gives b, though rounding would", "[lab03][ex5]") {
  judge_between(1, 2);
  judge_between(100, 100.0001f);
  judge_between(16777216, 16777218);
  judge_between(-3, std::nextafter(-3.0f, 0.0f));
}

TEST_CASE("Lab 3.5: float_between takes ends as far apart as floats go", "[lab03][ex5]") {
  judge_between(-3e38f, 3e38f);
}

// 600 000 numbers: a face that is off by 1.2 % of its probability is detected with power .999.
TEST_CASE("Lab 3.6: a die shows all six faces equally often", "[lab03][ex6]") {
  const Rows rows = integers(1, 6, 600'000);
  judge_range(rows, 1, 6);
  std::vector<double> counts(6);
  for (const double value : column(rows, 0)) {
    if (value >= 1 && value <= 6) ++counts[static_cast<std::size_t>(value) - 1];
  }
  judge(equals("faces that were seen",
               6.0 - static_cast<double>(std::count(counts.begin(), counts.end(), 0.0)), 6, 0,
               {{5, end_missing}}));
  judge(chi_square_is("how often the six faces come", counts,
                      std::vector<double>(6, static_cast<double>(rows.count()) / 6)));
}

// Three quarters of all words: any rule without rejection gives some values two words and others
// one. 100 000 numbers detect a rate of 1/3 that is off by .013; these mistakes make it 1/2.
TEST_CASE("Lab 3.6: no value of a wide range is favoured", "[lab03][ex6]") {
  const double u = -2147483648.0, values = 3221225472.0, v = u + values - 1;
  const Rows rows = integers(u, v, 100'000);
  judge_range(rows, u, v);
  const auto number = column(rows, 0);
  judge(share_is("the lowest third of the values",
                 indicator(number, [&](double x) { return x - u < values / 3; }), 1.0 / 3,
                 {{0.5, modulo}}));
  std::array<Verdict, 3> rests;
  std::array<double, 3> shares{};
  for (std::size_t rest = 0; rest < 3; ++rest) {
    const auto is_rest = indicator(
        number, [&](double x) { return std::fmod(x - u, 3) == static_cast<double>(rest); });
    shares[rest] = std::accumulate(is_rest.begin(), is_rest.end(), 0.0) / 100'000;
    rests[rest] = share_is(fmt::format("values u + 3 i + {}", rest), is_rest, 1.0 / 3, {});
  }
  const auto are = [&](double first, double others) {
    return std::abs(shares[0] - first) < 0.02 && std::abs(shares[1] - others) < 0.02 &&
           std::abs(shares[2] - others) < 0.02;
  };
  for (Verdict& rest : rests) {
    if (!rest.passed && are(0.5, 0.25)) rest.diagnoses.push_back(division);
    if (!rest.passed && are(1, 0)) rest.diagnoses.push_back(through_float);
    judge(rest);
  }
}

TEST_CASE("Lab 3.6: the ends are included, negative ones too", "[lab03][ex6]") {
  for (const auto& [u, v] : {std::pair{-3.0, 3.0},
                             {0.0, 1.0},
                             {-2147483648.0, -2147483647.0},
                             {2147483646.0, 2147483647.0}}) {
    const Rows rows = integers(u, v, 1000);
    judge_range(rows, u, v);
    const auto values = column(rows, 0);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    judge(equals(fmt::format("the least of 1000 numbers in [{:.0f}..{:.0f}]", u, v), *low, u, 0));
    judge(equals(fmt::format("the greatest of 1000 numbers in [{:.0f}..{:.0f}]", u, v), *high, v, 0,
                 {{v - 1, end_missing}}));
  }
}

TEST_CASE("Lab 3.6: a range of one value", "[lab03][ex6]") {
  for (const double u : {0.0, -7.0, 2147483647.0, -2147483648.0}) {
    const Rows rows = integers(u, u, 10);
    judge_range(rows, u, u);
    judge(equals("the number", rows.at(0, 0), u, 0));
  }
}

// 100 000 words give as many different numbers, except for about 1.2 words that occur twice. With
// 2^24 floats 300 pairs would be expected.
TEST_CASE("Lab 3.6: the range of all 2^32 numbers", "[lab03][ex6]") {
  const double u = -2147483648.0, v = 2147483647.0;
  const Rows rows = integers(u, v, 100'000);
  judge_range(rows, u, v);
  auto values = column(rows, 0);
  if (std::isinf(values.back())) return;
  judge(uniform_on("the numbers", values, u - 0.5, v + 0.5));
  std::sort(values.begin(), values.end());
  const auto distinct =
      static_cast<double>(std::unique(values.begin(), values.end()) - values.begin());
  const bool few = distinct < 1000;
  judge(holds("different numbers among 100 000", distinct > 99'970, fmt::format("{:.0f}", distinct),
              "99 999 or so", {few ? count_overflows : through_float}));
}

// Ranges that leave 3 words and 2; rejecting more would draw two words per number or favour some
// numbers. Wherever these lie for multiplication (Lemire: low half of the product below the limit),
// remainder (at the upper or the lower end), division or masks, they and their neighbours are among
// the words tested.
TEST_CASE("Lab 3.6: exactly the words left over are refused", "[lab03][ex6]") {
  judge_dealing(4294967293.0);
  judge_dealing(2147483647.0);
}

// Half of the words are left over here, the worst case: 2 draws per number on average, sd 1.41.
TEST_CASE("Lab 3.6: fewer than two words are drawn for a number, on average",
          "[lab03][ex6][efficiency]") {
  const double u = -2147483648.0;
  const Rows wide = integers(u, 0, 20'000);
  judge_range(wide, u, 0);
  double drawn = words_a_number(wide);
  judge(holds("words drawn for a number of 2^31 + 1", drawn >= 1 && drawn <= 2.08,
              fmt::format("{:.4g}", drawn), "2, give or take .06", {draws_too_many}));
  const Rows narrow = integers(0, 9, 20'000);
  drawn = words_a_number(narrow);
  judge(holds("words drawn for a number of 10", drawn >= 1 && drawn < 2,
              fmt::format("{:.4g}", drawn), "less than 2", {draws_too_many}));
}
