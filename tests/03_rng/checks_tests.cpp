// Checks of exercises 3.7 and 3.8: the chi-square test and the spectral test.

#include "03_rng/words.h"
#include "grader/judge/judge.h"
#include "stats/distributions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

using namespace carlo::grader;
using namespace lab03_tests;

namespace {

const Diagnosis freedom_of_cells{
    "degrees-of-freedom",
    "p is computed with as many degrees of freedom as there are counts; since their sum is "
    "given, there is one fewer."};
const Diagnosis by_counts{"divides-by-the-counts",
                          "the squares are divided by the counts, not by the expected values."};
const Diagnosis not_divided{"squares-not-divided",
                            "the squares are not divided by the expected values."};
const Diagnosis not_squared_differences{
    "differences-not-squared", "the differences from the expected values are not squared."};
const Diagnosis by_squares{"divided-by-squares",
                           "the squares are divided by the expected values squared: divide by "
                           "them once, for that is a count's variance."};
const Diagnosis root_taken{"root-of-the-statistic",
                           "this is the square root of the statistic: the distribution is that of "
                           "the sum of squares itself."};
const Diagnosis by_freedom{"divided-by-the-degrees",
                           "the statistic is divided by the degrees of freedom, which the "
                           "distribution takes into account."};
const Diagnosis too_few_degrees{"too-few-degrees",
                                "p is computed with two degrees of freedom fewer than there are "
                                "counts: only their sum is given, so there is one fewer."};
const Diagnosis two_sided{"two-sided-tail",
                          "a tail is the two-sided p: each of the two is asked for by itself."};
const Diagnosis by_bits{"expects-a-value-a-bit",
                        "words of b bits have 2^b values, not b: each is expected N / 2^b times."};
const Diagnosis tails_swapped{"tails-swapped", "the two tails are mixed up."};
const Diagnosis tail_by_difference{"tail-by-difference",
                                   "a tail is computed as 1 minus the other one: values below "
                                   "1e-16 are lost."};
const Diagnosis tail_not_set{"tail-not-set",
                             "a tail is still 1, the initial value of a TestResult: nothing was "
                             "stored."};
const Diagnosis wrong_field{"wrong-bits", "the field is cut out of the wrong place of the word."};
const Diagnosis whole_expectation{"expectation-rounded",
                                  "N / 2^bits is rounded to a whole number; it need not be one."};

using Counts = std::vector<double>;

double statistic_of(const Counts& counts, const Counts& expected) {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  return sum;
}

/// The mistakes that explain a wrong tail, given the other tail.
std::vector<Diagnosis> tail_diagnoses(double measured, double expected, double freedom_too_many,
                                      double freedom_too_few, double other_measured,
                                      double other_expected) {
  const auto is = [](double x, double y) { return std::abs(x - y) <= 1e-9 * y; };
  if (is(measured, other_expected) && is(other_measured, expected)) return {tails_swapped};
  if (measured == 1) return {tail_not_set};
  if (is(measured, freedom_too_many)) return {freedom_of_cells};
  if (is(measured, freedom_too_few)) return {too_few_degrees};
  if (is(measured, 2 * std::min(expected, other_expected))) return {two_sided};
  // Exactly: far out every wrong tail is near that difference, which is 0 or 1.
  if (measured == 1 - other_measured && is(other_measured, other_expected))
    return {tail_by_difference};
  return {};
}

/// Judges {statistic, lower, upper} against the truth about these counts; the tails only if they
/// belong to the right statistic.
void judge_result(const std::string& what, const double* result, const Counts& counts,
                  const Counts& expected, const Suspects& more = {}) {
  const double x = statistic_of(counts, expected);
  Suspects suspects = more;
  double plain = 0, neyman = 0, unsquared = 0, by_expected_squared = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double square = (counts[i] - expected[i]) * (counts[i] - expected[i]);
    plain += square;
    unsquared += std::abs(counts[i] - expected[i]) / expected[i];
    by_expected_squared += square / (expected[i] * expected[i]);
    if (counts[i] > 0) neyman += square / counts[i];
  }
  suspects.push_back({neyman, by_counts});
  suspects.push_back({plain, not_divided});
  suspects.push_back({unsquared, not_squared_differences});
  suspects.push_back({by_expected_squared, by_squares});
  suspects.push_back({std::sqrt(x), root_taken});
  suspects.push_back({x / static_cast<double>(counts.size() - 1), by_freedom});
  Verdict statistic =
      equals("the statistic of " + what, result[0], x, 1e-11 * std::max(x, 1e-3), suspects);
  const bool empty = std::find(counts.begin(), counts.end(), 0.0) != counts.end();
  // An empty cell adds (0 - expected)^2 / 0 with one mistake, 0 / 0 with the other.
  if (std::isinf(result[0]) && empty) statistic.diagnoses.push_back(by_counts);
  if (std::isnan(result[0]) && empty && expected[0] < 1)
    statistic.diagnoses.push_back(whole_expectation);
  judge(statistic);
  if (!statistic.passed) return;
  const auto freedom = static_cast<double>(counts.size() - 1);
  const std::array<double, 2> tails = {carlo::chi_square_lower(x, freedom),
                                       carlo::chi_square_upper(x, freedom)};
  const std::array<double, 2> too_many = {carlo::chi_square_lower(x, freedom + 1),
                                          carlo::chi_square_upper(x, freedom + 1)};
  // Two counts would leave none.
  const double few = std::max(freedom - 1, 0.5);
  const std::array<double, 2> too_few = {carlo::chi_square_lower(x, few),
                                         carlo::chi_square_upper(x, few)};
  for (std::size_t side = 0; side < 2; ++side) {
    // Far out a tail changes by freedom / 2 times the relative change of the statistic.
    Verdict tail = equals((side == 0 ? "the lower tail of " : "the upper tail of ") + what,
                          result[1 + side], tails[side], 1e-9 * tails[side]);
    if (!tail.passed) {
      tail.diagnoses = tail_diagnoses(result[1 + side], tails[side], too_many[side], too_few[side],
                                      result[2 - side], tails[1 - side]);
    }
    judge(tail);
  }
}

/// Infinities are judged, not refused: they come from dividing by a count of 0.
Shape three_numbers(const std::string& what) {
  return {.columns = 3, .finite = false, .of = what};
}

void judge_counts(const std::string& what, const Counts& counts, const Counts& expected) {
  Params params{.n = static_cast<std::int64_t>(counts.size())};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    params.numbers["count" + std::to_string(i)] = counts[i];
    params.numbers["expected" + std::to_string(i)] = expected[i];
  }
  const Rows rows = probe("Lab 3.7 counts", params, three_numbers(what));
  judge_result(what, rows.values.data(), counts, expected);
}

Counts field_counts(const std::vector<std::uint32_t>& words, int lowest, int bits) {
  Counts counts(std::size_t{1} << bits);
  for (const std::uint32_t word : words)
    ++counts[(word >> lowest) % counts.size()];
  return counts;
}

/// The shortest s^2 + t^2, found by trying every t that can matter: the shortest vector of a
/// lattice of determinant c is no longer than (4/3)^(1/4) sqrt(c).
double shortest_squared(std::uint64_t a, std::uint64_t c) {
  const double bound = std::sqrt(4.0 / 3) * static_cast<double>(c);
  double best = static_cast<double>(c) * static_cast<double>(c);
  for (std::uint64_t t = 1; static_cast<double>(t) * static_cast<double>(t) <= bound; ++t) {
    const std::uint64_t rest = (a % c) * (t % c) % c;  // a t < 2^64
    const auto s = static_cast<double>(std::min(rest, c - rest));
    best = std::min(best, s * s + static_cast<double>(t) * static_cast<double>(t));
  }
  return best;
}

struct Lcg {
  std::uint64_t a, c;
};

const Diagnosis not_squared{"length-not-squared", "nu_2 is returned; its square is required."};
const Diagnosis stops_early{"reduction-stops-early",
                            "the length is that of (-a, 1): the reduction stops before it has "
                            "begun."};
const Diagnosis overflows{"squares-overflow",
                          "squares of numbers up to 2^32 overflow 64 bits, where 2^64 becomes 0; "
                          "they need a Wide."};
const Diagnosis not_nearest{"quotient-not-nearest",
                            "the resulting vectors are not the shortest: is the multiple rounded "
                            "to the nearest whole number, also when it is negative?"};

/// One diagnosis that fits all lengths, including the right ones.
std::vector<Diagnosis> length_diagnoses(const std::vector<Lcg>& all,
                                        const std::vector<double>& measured,
                                        const std::vector<double>& exact) {
  const auto every = [&](auto fits) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!fits(i)) return false;
    }
    return true;
  };
  if (every([&](std::size_t i) { return measured[i] == std::floor(std::sqrt(exact[i])); }))
    return {not_squared};
  const auto unreduced = [&](std::size_t i) {
    const auto a = static_cast<double>(all[i].a);
    return std::abs(measured[i] - (a * a + 1)) <= 1e-12 * a * a;
  };
  if (every(unreduced)) return {stops_early};
  if (!every([&](std::size_t i) { return measured[i] >= exact[i]; })) return {overflows};
  return {not_nearest};
}

void judge_spectral(const std::vector<Lcg>& all) {
  std::vector<double> measured, exact;
  for (const auto& [a, c] : all) {
    const Params params{.numbers = {{"a", static_cast<double>(a)}, {"c", static_cast<double>(c)}}};
    measured.push_back(probe("Lab 3.8 length", params, {.finite = false}).at(0, 0));
    exact.push_back(shortest_squared(a, c));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    Verdict verdict = equals(fmt::format("nu_2^2 for a = {}, c = {}", all[i].a, all[i].c),
                             measured[i], exact[i], 0);
    if (!verdict.passed) verdict.diagnoses = length_diagnoses(all, measured, exact);
    if (std::isinf(measured[i])) verdict.measured = "a division by zero";
    judge(verdict);
  }
}

}  // namespace

// The second list: Knuth, The Art of Computer Programming 2, section 3.3.1, two dice thrown 144
// times; its chi-square is 7 7/48.
TEST_CASE("Lab 3.7: the statistic and both tails of given counts", "[lab03][ex7]") {
  judge_counts("18 22 20 25 15", {18, 22, 20, 25, 15}, {20, 20, 20, 20, 20});
  judge_counts("Knuth's dice", {2, 4, 10, 12, 22, 29, 21, 15, 14, 9, 6},
               {4, 8, 12, 16, 20, 24, 20, 16, 12, 8, 4});
  judge_counts("a coin", {480, 520}, {500, 500});
  judge_counts("expectations that are not whole", {3, 1, 4, 1, 5}, {2.8, 2.8, 2.8, 2.8, 2.8});
}

TEST_CASE("Lab 3.7: tails far out keep their digits", "[lab03][ex7]") {
  const Counts even(256, 4096);
  Counts close = even, wild = even;
  close[0] += 1;
  close[1] -= 1;
  for (std::size_t i = 0; i < 256; ++i)
    wild[i] += i % 2 == 0 ? 100 : -100;
  // Off by 5 of 10 000: the statistic is .64, and about 1e-275 of all generators are as even.
  const Counts thousands(256, 10'000);
  Counts smooth = thousands;
  for (std::size_t i = 0; i < 256; ++i)
    smooth[i] += i % 2 == 0 ? 5 : -5;
  judge_counts("256 counts of 10 000 ± 5", smooth, thousands);
  judge_counts("256 counts that are all but equal", close, even);
  judge_counts("256 counts off by 100", wild, even);
  const Params params{.n = 65'536, .numbers = {{"bits", 8}}};
  const std::string what = "words that count up";
  const Rows rows = probe("Lab 3.7 counting words", params, three_numbers(what));
  judge_result(what, rows.values.data(), Counts(256, 256), Counts(256, 256));
}

TEST_CASE("Lab 3.7: equidistribution looks at the bits it is told to", "[lab03][ex7]") {
  constexpr std::int64_t n = 30'000;
  for (const auto& field :
       {std::pair{22, 10}, {0, 8}, {0, 1}, {31, 1}, {16, 16}, {0, 16}, {5, 3}, {13, 7}}) {
    const int lowest = field.first, bits = field.second;
    const std::string what = fmt::format("{} bits from bit {}", bits, lowest);
    const Answer rows = probe(
        "Lab 3.7 words", {.n = n, .numbers = {{"lowest", double(lowest)}, {"bits", double(bits)}}},
        three_numbers(what));
    const std::vector<std::uint32_t> words = random_words(rows.seed, n);
    const auto cells = std::size_t{1} << bits;
    const double each = static_cast<double>(n) / static_cast<double>(cells);
    const Counts expected(cells, each);
    const Counts rounded(cells, std::floor(each));
    const auto other = [&](int place) {
      return statistic_of(field_counts(words, place, bits), expected);
    };
    Suspects suspects{{other(32 - lowest - bits), wrong_field}};
    if (lowest > 0) suspects.push_back({other(0), wrong_field});
    const Counts counts = field_counts(words, lowest, bits);
    suspects.push_back({statistic_of(counts, Counts(cells, double(n) / bits)), by_bits});
    if (each >= 1 && each != std::floor(each)) {
      suspects.push_back({statistic_of(counts, rounded), whole_expectation});
    }
    judge_result(what, rows.values.data(), counts, expected, suspects);
  }
}

// nu_2 = 70277.4 for the lecture's constants.
TEST_CASE("Lab 3.8: the constants of the lecture, of RANDU, of MINSTD", "[lab03][ex8]") {
  judge_spectral({{1664525, std::uint64_t{1} << 32},
                  {65539, std::uint64_t{1} << 31},
                  {16807, 2147483647},
                  {69069, std::uint64_t{1} << 32},
                  {48271, 2147483647}});
}

TEST_CASE("Lab 3.8: small generators and extreme ones", "[lab03][ex8]") {
  const std::uint64_t most = std::uint64_t{1} << 32;
  std::vector<Lcg> all = {{1, 2},
                          {1, most},
                          {2, most},
                          {most - 1, most},
                          {most / 2, most},
                          {most / 2 + 1, most},
                          {3 * (most / 4), most},
                          {65535, most},
                          {4294967290, 4294967291}};
  for (std::uint64_t a = 1; a < 12; ++a)
    all.push_back({a, 12});
  judge_spectral(all);
}

TEST_CASE("Lab 3.8: multipliers of all kinds", "[lab03][ex8]") {
  std::uint64_t a = 12345;
  std::vector<Lcg> all;
  for (int i = 0; i < 40; ++i) {
    a = a * 6364136223846793005 + 1442695040888963407;
    const std::uint64_t c = (std::uint64_t{1} << 32) - (i % 2 == 0 ? 0 : (a >> 40) % 1000);
    all.push_back({(a >> 33) + 1, c});
  }
  judge_spectral(all);
}
