// Checks of exercise 1.3. All lists have exact answers.

#include "01_integration/drawn.h"
#include "01_integration/slips.h"
#include "grader/judge/judge.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

const Diagnosis by_n{"variance-divided-by-n",
                     "the sum of squares is divided by N; the unbiased estimate takes N - 1."};
const Diagnosis not_a_mean{"standard-error-of-one-number",
                           "the standard deviation of one number is given; that of the mean is "
                           "smaller by sqrt(N)."};
const Diagnosis cancellation{"sum-of-squares-cancellation",
                             "the variance is lost where the mean is large: two sums of nearly "
                             "equal size are subtracted."};
const Diagnosis old_mean_twice{"both-distances-to-the-old-mean",
                               "m2 grows by the square of the distance to the old mean; one of the "
                               "two distances is the one to the new mean."};
const Diagnosis new_mean_twice{"both-distances-to-the-new-mean",
                               "m2 grows by the square of the distance to the new mean; one of the "
                               "two distances is the one to the old mean."};
const Diagnosis no_root{"standard-error-squared",
                        "the square of the standard error is given: its square root is missing."};
const Diagnosis divided_by_all{"standard-error-divided-by-n",
                               "the standard deviation is divided by N, not by sqrt(N)."};
const Diagnosis between_missing{"merge-without-between-means",
                                "merging adds the spread within each part; the difference of "
                                "their means adds to the spread as well."};
const Diagnosis others_spread_missing{
    "merge-without-the-others-spread",
    "merging leaves out how much the other part's numbers scatter about their own mean: its m2 has "
    "to be added, too."};
const Diagnosis by_one_count{"merged-mean-by-one-count",
                             "the merged mean is divided by the count of one part alone; it is the "
                             "mean of the numbers of both."};
const Diagnosis from_moved_mean{"merge-from-the-moved-mean",
                                "the distance between the two means is taken after the mean has "
                                "moved; merging needs the distance before."};
const Diagnosis mean_of_means{"mean-of-the-means",
                              "the merged mean is half-way between the two means, as if both "
                              "parts held equally many numbers."};
const Diagnosis counted_late{"divided-by-the-count-before",
                             "the mean of one number is NaN: its distance is divided by 0, a "
                             "count that does not include the new number yet."};
const Diagnosis few_numbers{
    "statistics-of-too-few",
    "the mean of no number and the variance of fewer than two are undefined: the contract "
    "requires 0 there, and 0/0 is not 0."};

const Diagnosis nothing_merged{"merge-of-nothing",
                               "two parts without a number are merged into NaN: their counts add "
                               "up to 0, and something is divided by that."};

/// The right results for a list of numbers.
struct Exact {
  double count, mean, variance;
  double standard_error() const { return count < 2 ? 0 : std::sqrt(variance / count); }
};

Rows list(int pattern, std::int64_t n, double offset = 0) {
  return probe(
      "Lab 1.3 list", {.n = n, .numbers = {{"pattern", pattern}, {"offset", offset}}},
      {.columns = 4,
       .finite = false,
       .of = fmt::format("a list of {} {} around {:g}", n, n == 1 ? "number" : "numbers", offset)});
}

/// The variance of `numbers` if both factors of Welford's product were the distance to the same
/// mean, the old one or the new one.
Suspects same_distance_twice(const std::vector<double>& numbers) {
  double n = 0, mean = 0, by_old = 0, by_new = 0;
  for (const double x : numbers) {
    const double old_mean = mean;
    mean += (x - mean) / ++n;
    by_old += (x - old_mean) * (x - old_mean);
    by_new += (x - mean) * (x - mean);
  }
  if (n < 2) return {};
  return {{by_old / (n - 1), old_mean_twice}, {by_new / (n - 1), new_mean_twice}};
}

/// The effect of mistakes on a list's mean and variance.
struct Slips {
  Suspects means, variances;
};

/// For numbers that are added one by one.
Slips slips_of(const std::vector<double>& numbers) {
  Slips slips{{}, same_distance_twice(numbers)};
  // With (1/n) in whole numbers, (x - mean) * (1/n) moves the mean only once.
  if (numbers.size() > 1) slips.means.push_back({numbers[0], whole_division});
  return slips;
}

double mean_of(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double x : numbers)
    sum += x;
  return numbers.empty() ? 0 : sum / static_cast<double>(numbers.size());
}

/// The sum of the squared distances from the mean.
double spread_within(const std::vector<double>& part) {
  double sum = 0;
  for (const double x : part)
    sum += (x - mean_of(part)) * (x - mean_of(part));
  return sum;
}

/// The mean of parts merged one after the other if each merge takes the average of two means.
/// `from_nothing`: even if nothing was there before; `with_nothing`: even if nothing is added.
double half_way(const std::vector<std::vector<double>>& parts, bool from_nothing,
                bool with_nothing) {
  double mean = mean_of(parts[0]);
  bool nothing = parts[0].empty();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].empty() && !with_nothing) continue;
    mean = nothing && !from_nothing ? mean_of(parts[i]) : (mean + mean_of(parts[i])) / 2;
    nothing = nothing && parts[i].empty();
  }
  return mean;
}

/// The variance of parts merged one after the other if the distance of the two means is taken only
/// after the mean has moved.
double variance_from_moved_mean(const std::vector<std::vector<double>>& parts) {
  double n = 0, mean = 0, m2 = 0;
  for (const std::vector<double>& part : parts) {
    if (part.empty()) continue;
    const auto count = static_cast<double>(part.size());
    const double part_mean = mean_of(part);
    mean += (part_mean - mean) * count / (n + count);
    m2 += spread_within(part) + (part_mean - mean) * (part_mean - mean) * n * count / (n + count);
    n += count;
  }
  return m2 / (n - 1);
}

/// The mean of parts merged one after the other if each merge divides by the numbers before it, not
/// by all: of the distance of the means (`moved`), or of the sum of both.
double mean_by_one_count(const std::vector<std::vector<double>>& parts, bool moved) {
  double n = 0, mean = 0;
  for (const std::vector<double>& part : parts) {
    const auto count = static_cast<double>(part.size());
    if (part.empty()) continue;
    const double added = moved ? mean_of(part) - mean : mean_of(part);
    mean = n == 0 ? mean_of(part) : mean + added * count / n;
    n += count;
  }
  return mean;
}

/// The variance of parts merged one after the other if the spread within each part but the first is
/// left out. `copied`: a part that is merged into nothing keeps its own.
double variance_without_the_others(const std::vector<std::vector<double>>& parts, bool copied) {
  double n = 0, mean = 0, m2 = spread_within(parts[0]);
  for (const std::vector<double>& part : parts) {
    if (part.empty()) continue;
    if (n == 0 && copied) m2 = spread_within(part);
    const auto count = static_cast<double>(part.size());
    const double distance = mean_of(part) - mean;
    if (n > 0) m2 += distance * distance * n * count / (n + count);
    mean += distance * count / (n + count);
    n += count;
  }
  return m2 / (n - 1);
}

/// The effect of mistakes on the mean and the variance of merged parts.
Slips slips_of_merging(const std::vector<std::vector<double>>& parts) {
  Slips slips{{}, {{variance_from_moved_mean(parts), from_moved_mean}}};
  for (const bool either : {false, true}) {
    slips.means.push_back({mean_by_one_count(parts, either), by_one_count});
    slips.variances.push_back({variance_without_the_others(parts, either), others_spread_missing});
  }
  for (const bool from_nothing : {false, true}) {
    for (const bool with_nothing : {false, true})
      slips.means.push_back({half_way(parts, from_nothing, with_nothing), mean_of_means});
  }
  // n2/(n1 + n2) in whole numbers is 0 unless the first part is empty.
  for (const std::vector<double>& part : parts) {
    if (part.empty()) continue;
    slips.means.push_back({mean_of(part), whole_division});
    break;
  }
  return slips;
}

/// Judges the mean. For numbers added one by one, a NaN has a known cause.
Verdict mean_verdict(const std::string& what, double mean, const Exact& exact, double tolerance,
                     const Suspects& suspects, bool one_by_one) {
  Verdict verdict = equals(what, mean, exact.mean, tolerance * std::abs(exact.mean), suspects);
  if (one_by_one && !std::isfinite(mean)) {
    verdict.diagnoses = {exact.count > 0 ? counted_late : few_numbers};
  }
  return verdict;
}

/// Judges row `row` of {count, mean, variance, standard error}. If the mean is wrong, the rest says
/// nothing.
void judge_moments(const std::string& list_name, const Rows& rows, std::size_t row,
                   const Exact& exact, double tolerance, const Slips& slips = {},
                   bool one_by_one = false) {
  judge(equals("the count of " + list_name, rows.at(row, 0), exact.count, 0));
  const Verdict mean = mean_verdict("the mean of " + list_name, rows.at(row, 1), exact, tolerance,
                                    slips.means, one_by_one);
  judge(mean);
  const double by_all = exact.variance * (exact.count - 1) / exact.count;
  Suspects variances, errors;
  if (mean.passed && exact.count > 1) {
    variances = slips.variances;
    variances.push_back({by_all, by_n});
    errors = {{std::sqrt(exact.variance), not_a_mean},
              {std::sqrt(by_all), not_a_mean},
              {exact.variance / exact.count, no_root},
              {std::sqrt(exact.variance) / exact.count, divided_by_all}};
  }
  Verdict variance = equals("the variance of " + list_name, rows.at(row, 2), exact.variance,
                            tolerance * exact.variance, variances);
  Verdict error = equals("the standard error of " + list_name, rows.at(row, 3),
                         exact.standard_error(), tolerance * exact.standard_error(), errors);
  for (Verdict* verdict : {&variance, &error}) {
    if (mean.passed && exact.count < 2 && !verdict->passed) verdict->diagnoses = {few_numbers};
    judge(*verdict);
  }
}

constexpr double rounding = 1e-12;
constexpr bool one_by_one = true;

}  // namespace

TEST_CASE("Lab 1.3: mean, variance and standard error of a short list", "[lab01][ex3]") {
  judge_moments("2 4 4 4 5 5 7 9", list(0, 8), 0, {8, 5, 32.0 / 7}, rounding,
                slips_of({2, 4, 4, 4, 5, 5, 7, 9}), one_by_one);
  judge_moments("2 4 4", list(0, 3), 0, {3, 10.0 / 3, 4.0 / 3}, rounding, slips_of({2, 4, 4}),
                one_by_one);
  judge_moments("2 4", list(0, 2), 0, {2, 3, 2}, rounding, slips_of({2, 4}), one_by_one);
}

// A submission that has memorised the other lists does not know these.
TEST_CASE("Lab 1.3: lists of random numbers", "[lab01][ex3]") {
  for (const std::int64_t n : {5, 37}) {
    const Answer rows = probe("Lab 1.3 drawn list", {.n = n},
                              {.rows = 2, .columns = 4, .of = fmt::format("{} random numbers", n)});
    const DrawnList drawn = drawn_list(rows.seed, n);
    const std::vector<double>& numbers = drawn.numbers;
    const auto cut = numbers.begin() + static_cast<std::ptrdiff_t>(drawn.cut);
    double mean = 0, squares = 0;
    for (const double x : numbers)
      mean += x / static_cast<double>(n);
    for (const double x : numbers)
      squares += (x - mean) * (x - mean);
    const Exact exact{static_cast<double>(n), mean, squares / static_cast<double>(n - 1)};
    judge_moments(fmt::format("{} random numbers", n), rows, 0, exact, rounding, slips_of(numbers),
                  one_by_one);
    judge_moments(fmt::format("{} random numbers in two parts", n), rows, 1, exact, rounding,
                  slips_of_merging({{numbers.begin(), cut}, {cut, numbers.end()}}));
  }
}

TEST_CASE("Lab 1.3: one number has no variance, and no number has no mean", "[lab01][ex3]") {
  judge_moments("the list of 2 alone", list(0, 1), 0, {1, 2, 0}, rounding, {}, one_by_one);
  judge_moments("the empty list", list(0, 0), 0, {0, 0, 0}, rounding, {}, one_by_one);
}

// A million numbers alternating between 1e8 - 1 and 1e8 + 1: the variance is N / (N - 1). The sum
// of squares, 1e22, loses it entirely; Welford's update loses at most 1e-8 (the mean's rounding).
TEST_CASE("Lab 1.3: the variance survives a mean of 1e8", "[lab01][ex3]") {
  for (const double n : {10.0, 1'000'000.0}) {
    const Rows rows = list(1, static_cast<std::int64_t>(n), 1e8);
    const double variance = n / (n - 1);
    judge(equals("the mean", rows.at(0, 1), 1e8, 1e-6));
    Verdict verdict = equals(fmt::format("the variance of {:g} numbers 1e8 ± 1", n), rows.at(0, 2),
                             variance, 1e-5, {{1, by_n}});
    // It is cancellation if the same numbers around 0 give the right variance.
    const Rows around_zero = list(1, static_cast<std::int64_t>(n), 0);
    const bool right = std::abs(around_zero.at(0, 2) - variance) <= 1e-9;
    const bool far = !(std::abs(rows.at(0, 2) - variance) <= 0.2);
    if (!verdict.passed && right && far) verdict.diagnoses.push_back(cancellation);
    judge(verdict);
  }
}

// 0 1 4 9 ... 49: mean 17.5, sum of squares 4676, so m2 = 4676 - 8 * 17.5^2 = 2226.
TEST_CASE("Lab 1.3: parts merged are the whole, however it is cut", "[lab01][ex3]") {
  const Rows rows =
      probe("Lab 1.3 merge", {.n = 8, .numbers = {{"pattern", 2}, {"offset", 0}}},
            {.rows = 45, .columns = 4, .finite = false, .of = "a list of 8 numbers, in parts"});
  // The first row's first two parts are empty.
  const bool list_has_mean = std::isfinite(list(2, 8).at(0, 1));
  judge(is_so("a mean, where two empty parts are merged first", std::isfinite(rows.at(0, 1)),
              "no number", "the mean of the other part",
              {list_has_mean ? nothing_merged : counted_late}));
  const auto spread = [](int first, int last) {
    double sum = 0, squares = 0;
    for (int i = first; i < last; ++i) {
      sum += i * i;
      squares += std::pow(i, 4);
    }
    return first == last ? 0 : squares - sum * sum / (last - first);
  };
  const auto squares_of = [](int first, int last) {
    std::vector<double> numbers;
    for (int i = first; i < last; ++i)
      numbers.push_back(i * i);
    return numbers;
  };
  std::size_t row = 0;
  for (int first = 0; first <= 8; ++first) {
    for (int second = first; second <= 8; ++second) {
      const double within = spread(0, first) + spread(first, second) + spread(second, 8);
      Slips slips = slips_of_merging(
          {squares_of(0, first), squares_of(first, second), squares_of(second, 8)});
      if (within < 2225) slips.variances.push_back({within / 7, between_missing});
      judge_moments(fmt::format("0 1 4 ... 49 cut after {} and {}", first, second), rows, row++,
                    {8, 17.5, 318}, rounding, slips);
    }
  }
}

TEST_CASE("Lab 1.3: many merges keep the variance at a mean of 1e8", "[lab01][ex3]") {
  const double n = 7'000;
  const Rows rows = probe("Lab 1.3 merge many",
                          {.n = 7'000, .numbers = {{"pattern", 1}, {"offset", 1e8}, {"length", 7}}},
                          {.columns = 4, .of = "7000 numbers around 1e+08, in parts of 7"});
  const double variance = n / (n - 1);
  judge(equals("the count", rows.at(0, 0), n, 0));
  const Verdict mean = equals("the mean", rows.at(0, 1), 1e8, 1e-6);
  judge(mean);
  // Seven numbers -1 1 ... -1 lie 6/7 * 8 / 7 about their own mean. That this is lost has two
  // causes here: it was left out, or cancelled.
  judge(equals("the variance of 1000 parts of 7 numbers 1e8 ± 1", rows.at(0, 2), variance, 1e-5,
               mean.passed ? Suspects{{1000 * (48.0 / 7) / (n - 1), between_missing}, {1, by_n}}
                           : Suspects{}));
}
