// Checks of exercise 3.3: the recurrence, exactly; the first words, by their required properties.

#include "03_rng/sequences.h"
#include "03_rng/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace carlo::grader;
using namespace lab03_tests;

namespace {

const Unsaid unsaid{"combine"};

const Diagnosis operands_swapped{"operands-swapped",
                                 "x_{n-k} - x_{n-j} is computed; it is x_{n-j} - x_{n-k}."};
const Diagnosis wrong_place{
    "wrong-place-in-ring",
    "the word used as x_{n-j} is j places after the oldest one, not j places before the newest."};
const Diagnosis late{"returns-the-oldest",
                     "every number comes k calls late: the word that is replaced is returned."};
const Diagnosis all_even{"all-words-even",
                         "all first words are even: with + and - the lowest bit then stays 0 for "
                         "ever."};
const Diagnosis not_hashed{
    "seed-not-hashed",
    "first words of neighbouring seeds, or neighbouring words, depend on each other: each word "
    "needs its own hash of the seed."};
const Diagnosis seeds_shift{
    "seeds-shift-one-stream",
    "seeds share words at different places: the sum of seed and place is hashed, and many seeds "
    "give the same sums."};
const Diagnosis word_constant{"first-word-constant",
                              "one word is the same for every seed: to make it odd, set its "
                              "lowest bit and keep the others."};
const Diagnosis bits_fixed{"bits-fixed", "some bits are the same in every word."};
const Diagnosis all_odd{
    "too-many-odd",
    "more words are made odd than necessary: the lowest bits of all numbers then follow one "
    "pattern, the same for all seeds."};
const Diagnosis moves_all{"not-constant-time",
                          "the time grows with k: erasing at the front moves all words. Write the "
                          "new word over the oldest one, and move oldest_ on."};
const Diagnosis seed_cut{"seed-cut-to-32-bits", "only the lower 32 bits of the seed are used."};
const Diagnosis seed_ignored{"seed-ignored", "different seeds give the same words."};
const Diagnosis not_repeatable{"not-repeatable",
                               "the same seed gives different words the second time."};

constexpr std::int64_t many_seeds = 20'000;
constexpr double bit_slack = 0.0266;

enum class Slip { none, swapped, place, oldest };

std::uint32_t combined(int combine, std::uint32_t x, std::uint32_t y) {
  return combine == 0 ? x + y : combine == 1 ? x - y : x ^ y;
}

/// The next n numbers, by the definition: a list that grows.
std::vector<double> lagged(std::size_t j, int combine, std::vector<std::uint32_t> words,
                           std::int64_t n, Slip slip = Slip::none) {
  const std::size_t k = words.size();
  return generate(n, [&] {
    const std::size_t at = words.size();
    const std::uint32_t oldest = words[at - k];
    const std::uint32_t near = slip == Slip::place ? words[at - k + j] : words[at - j];
    words.push_back(slip == Slip::swapped ? combined(combine, oldest, near)
                                          : combined(combine, near, oldest));
    return static_cast<double>(slip == Slip::oldest ? oldest : words.back());
  });
}

void judge_recurrence(int j, int k, int combine, std::int64_t n) {
  constexpr std::array<const char*, 3> names = {"+", "-", "xor"};
  const std::string which =
      fmt::format("({}, {}), {}", j, k, names[static_cast<std::size_t>(combine)]);
  const Answer rows =
      probe("Lab 3.3 recurrence",
            {.n = n, .numbers = {{"j", double(j)}, {"k", double(k)}, {"combine", double(combine)}}},
            {.rows = static_cast<std::size_t>(n), .of = which});
  const std::vector<std::uint32_t> first = random_words(rows.seed, k);
  const auto with = [&](Slip slip) {
    return lagged(static_cast<std::size_t>(j), combine, first, n, slip);
  };
  std::vector<Alternative> slips = {{with(Slip::place), wrong_place}, {with(Slip::oldest), late}};
  if (combine == 1) slips.push_back({with(Slip::swapped), operands_swapped});
  judge(sequence_is("the numbers for " + which, rows.values, with(Slip::none), slips));
}

Rows seeded(std::uint64_t first, std::int64_t n, std::size_t k) {
  Params params{.n = n, .numbers = {{"k", static_cast<double>(k)}}};
  set_wide_word(params, "first", first);
  return probe("Lab 3.3 first words", params,
               {.rows = static_cast<std::size_t>(n),
                .columns = 2 * k,
                .of = fmt::format("{} seeds from {:#x}, k = {}", n, first, k)});
}

/// A word as a number with mean 0 and variance 1.
double standardised(double word) {
  return (word * 0x1p-32 - 0.5) * std::sqrt(12.0);
}

/// Products of two columns, of rows `apart` from each other: for independent words they have mean
/// 0, variance 1 and, since E[x^4] = 9/5, excess kurtosis 81/25 - 3.
std::vector<double> products(const Rows& rows, std::size_t x, std::size_t y, std::size_t apart) {
  std::vector<double> values;
  for (std::size_t i = 0; i + apart < rows.count(); i += apart + 1)
    values.push_back(standardised(rows.at(i, x)) * standardised(rows.at(i + apart, y)));
  return values;
}

/// For each of the first words: how often each bit is 1.
std::vector<std::array<double, 32>> shares_of_ones(const Rows& rows, std::size_t places) {
  std::vector<std::array<double, 32>> shares(places);
  for (std::size_t place = 0; place < places; ++place) {
    for (std::size_t i = 0; i < rows.count(); ++i) {
      const auto word = static_cast<std::uint32_t>(rows.at(i, place));
      for (std::size_t bit = 0; bit < 32; ++bit)
        shares[place][bit] += (word >> bit) & 1;
    }
    for (double& share : shares[place])
      share /= static_cast<double>(rows.count());
  }
  return shares;
}

void judge_independent(const std::string& what, const std::vector<double>& values) {
  Verdict verdict = mean_is("the correlation of " + what, values, {.mean = 0, .sd = 1});
  if (!verdict.passed) verdict.diagnoses.push_back(not_hashed);
  judge(verdict);
}

}  // namespace

TEST_CASE("Lab 3.3: x_n = x_{n-j} op x_{n-k} mod 2^32, for the lecture's lags", "[lab03][ex3]") {
  constexpr std::array<std::array<int, 2>, 6> lags = {
      {{7, 10}, {5, 17}, {6, 31}, {24, 55}, {31, 63}, {1, 2}}};
  for (const auto& [j, k] : lags) {
    for (int combine = 0; combine < 3; ++combine)
      judge_recurrence(j, k, combine, 500);
  }
}

// random() of the GNU C library is the additive generator (3, 31): its 31 first words are MINSTD's
// numbers from the seed, the first 310 numbers are left out, and the lowest bit is dropped. These
// are the first five after srandom(1).
TEST_CASE("Lab 3.3: the numbers of random() in the GNU C library come out", "[lab03][ex3]") {
  Params params{.n = 5, .numbers = {{"skip", 310}}};
  std::int64_t word = 1;
  for (int i = 0; i < 31; ++i) {
    params.numbers["word" + std::to_string((i + 28) % 31)] = static_cast<double>(word);
    word = word * 16807 % 2147483647;
  }
  Rows rows = probe("Lab 3.3 known answer", params, {.rows = 5, .of = "srandom(1)"});
  for (double& value : rows.values)
    value = std::floor(value / 2);
  judge(sequence_is("random() after srandom(1)", rows.values,
                    {1804289383, 846930886, 1681692777, 1714636915, 1957747793}));
}

// With one word or two, a hash alone makes all words even for a half or a quarter of the seeds.
TEST_CASE("Lab 3.3: at least one first word is odd, whatever the seed", "[lab03][ex3]") {
  for (const std::size_t k : {1u, 2u, 10u, 63u}) {
    const Rows rows = seeded(0, 500, k);
    double without = 0;
    for (std::size_t i = 0; i < rows.count(); ++i) {
      bool odd = false;
      for (std::size_t c = 0; c < k; ++c)
        odd = odd || std::fmod(rows.at(i, c), 2) == 1;
      if (!odd) ++without;
    }
    judge(equals(fmt::format("seeds of 0 to 499 without an odd word among {}", k), without, 0, 0,
                 {{without, all_even}}));
  }
}

TEST_CASE("Lab 3.3: the same seed gives the same words, another one others", "[lab03][ex3]") {
  const Rows rows = seeded(0, 1000, 10);
  const Rows far = seeded(std::uint64_t{1} << 32, 1000, 10);
  bool repeated = true;
  std::set<std::vector<double>> distinct;
  std::size_t from_low_half = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    std::vector<double> once, again, other;
    for (std::size_t c = 0; c < 10; ++c) {
      once.push_back(rows.at(i, c));
      again.push_back(rows.at(i, c + 10));
      other.push_back(far.at(i, c));
    }
    repeated = repeated && once == again;
    if (once == other) ++from_low_half;
    distinct.insert(once);
  }
  judge(is_so("the words of a seed that is asked twice", repeated, "not the same", "the same",
              {not_repeatable}));
  judge(equals("different lists of words from 1000 seeds", static_cast<double>(distinct.size()),
               1000, 0, {{1, seed_ignored}}));
  judge(equals("seeds s with the words of s + 2^32", static_cast<double>(from_low_half), 0, 0,
               {{1000, seed_cut}}));
}

// 10 000 pairs per comparison: a correlation of .087 is detected with power .999; seeds or words
// that count up have correlations near 1 here, and so do unhashed LCG starts (their product is a
// step function of the seed, far from uniform over 20 000 seeds).
TEST_CASE("Lab 3.3: first words of neighbouring seeds and places are independent", "[lab03][ex3]") {
  const Rows rows = seeded(1, many_seeds, 10);
  std::vector<double> second, last;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    second.push_back(rows.at(i, 1));
    last.push_back(rows.at(i, 9));
  }
  for (const auto* words : {&second, &last}) {
    Verdict verdict = uniform_on("a first word over 20 000 seeds", *words, 0, 0x1p32);
    if (!verdict.passed) verdict.diagnoses.push_back(not_hashed);
    judge(verdict);
  }
  judge_independent("a word for seeds s and s + 1", products(rows, 4, 4, 1));
  judge_independent("words i for s and i + 1 for s + 1", products(rows, 4, 5, 1));
  judge_independent("words i + 1 for s and i for s + 1", products(rows, 5, 4, 1));
  judge_independent("words i and i + 1 of a seed", products(rows, 6, 7, 0));
  judge_independent("words i and i + 2 of a seed", products(rows, 6, 8, 0));
}

// A hash of s + i gives every seed the words of its neighbours, shifted. Among 20 000 independent
// words .047 pairs are expected to be equal; five or more have a probability of 2e-9.
TEST_CASE("Lab 3.3: no seed has the words of another one", "[lab03][ex3]") {
  std::set<double> distinct;
  double all = 0;
  // The second block is one step of splitmix64 away.
  for (const std::uint64_t first : {std::uint64_t{7}, std::uint64_t{7} + 0x9E3779B97F4A7C15}) {
    const Rows rows = seeded(first, 1000, 10);
    for (std::size_t i = 0; i < rows.count(); ++i) {
      for (std::size_t c = 0; c < 10; ++c)
        distinct.insert(rows.at(i, c));
      all += 10;
    }
  }
  const double repeated = all - static_cast<double>(distinct.size());
  std::vector<Diagnosis> many;  // a constant word repeats a tenth, a narrow hash a few
  if (repeated > 0.3 * all) many.push_back(seeds_shift);
  judge(holds("words that come again, among 10 first words of each of 2000 seeds", repeated < 5,
              fmt::format("{}", repeated), "none or so", many));
}

// 20 000 seeds: the rate of ones of a bit has the standard deviation .0035, and 7.5 of these are
// allowed for each of 320 bits (alpha 2e-11 in all). The lowest bit of one word may be set: then
// the words of a seed contain on average half an odd one more than by chance (sd .011, 8 of these
// allowed).
TEST_CASE("Lab 3.3: every bit of the first words is 0 or 1 equally often", "[lab03][ex3]") {
  const Rows rows = seeded(1, many_seeds, 10);
  const auto shares = shares_of_ones(rows, 10);
  double odd_words = 0;
  bool balanced = true, constant = false, fixed = false;
  std::string worst = "all about half";
  for (std::size_t place = 0; place < 10; ++place) {
    const auto& share = shares[place];
    odd_words += share[0] - 0.5;
    std::size_t same = 0;
    for (std::size_t bit = 0; bit < 32; ++bit) {
      const double limit = bit == 0 ? 0.5 : bit_slack;
      if (share[bit] == 0 || share[bit] == 1) ++same;
      if (share[bit] - 0.5 <= limit && share[bit] - 0.5 >= -bit_slack) continue;
      if (balanced) worst = fmt::format("word {}, bit {}: {:.3f}", place, bit, share[bit]);
      balanced = false;
    }
    constant = constant || same == 32;
    fixed = fixed || (same > 1 && same < 32);
  }
  std::vector<Diagnosis> bits;
  if (constant) bits.push_back(word_constant);
  if (fixed) bits.push_back(bits_fixed);
  judge(holds("the share of ones in each bit, over 20 000 seeds", balanced, worst,
              "0.5 ± 0.027, but for a lowest bit that is set", bits));
  judge(holds("odd words a seed beyond the half that chance makes odd", odd_words <= 0.59,
              fmt::format("{:.3f} among 10", odd_words), "0.5 at most, from one that is made odd",
              {all_odd}));
}

// erase() at the front of a vector moves all other words. 4000 numbers then take half a second with
// a million words; with a ring they take less than a millisecond, whatever k is.
TEST_CASE("Lab 3.3: a number takes the same time for every k", "[lab03][ex3][efficiency]") {
  const Rows rows = probe("Lab 3.3 cost", {.n = 4000, .numbers = {{"k", 1e6}}}, {});
  judge(holds("the time of 4000 numbers, k = 1 000 000", rows.at(0, 0) <= 0.1,
              fmt::format("{:.3g} s", rows.at(0, 0)), "less than 0.1 s", {moves_all}));
}
