// Checks of exercise 2.5. The darts are given by the contract, so the count has one right value.

#include "02_pi/reference.h"
#include "grader/judge/judge.h"
#include "grader/judge/process.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>

using namespace carlo::grader;
using lab02_tests::dart_of;
using lab02_tests::hits_of;
using lab02_tests::plain_loop;

namespace {

const Diagnosis corner{"corner-of-the-cell",
                       "a dart lies at the centre of its cell, half a step from (x, y): if the "
                       "corner is taken, slightly too many darts hit."};
const Diagnosis fast_float_counter{
    "float-counter", "the hits stop at 16777216 = 2^24: a float cannot count further."};
const Diagnosis ragged{
    "range-not-in-whole-rounds",
    "ranges that begin with an even dart and have a round length are right, others are not: "
    "check the darts before the first whole word and after the last whole round."};
const Diagnosis cut_number{"dart-number-in-32-bits",
                           "far along the list the darts are wrong: a dart's number is kept in "
                           "32 bits somewhere, and overflows after 2^32 - 1."};
const Diagnosis cut_squares{"squares-in-32-bits",
                            "bits are lost: the sum of two squares, or the square that it is "
                            "compared with, needs more than 32 of them, and the product of two "
                            "32-bit numbers has only 32."};
const Diagnosis small_counter{
    "counter-overflows",
    "the hits are kept in too few bits: past the largest number that these can hold, the count "
    "wraps around."};
const Diagnosis slow{"not-faster",
                     "the count is right, but a dart takes too long: see ./carlo hint 2.5."};

/// Only right counts are reported as slow.
std::vector<Diagnosis> slow_if(bool right) {
  return right ? std::vector<Diagnosis>{slow} : std::vector<Diagnosis>{};
}

#ifdef __OPTIMIZE__
constexpr bool optimised = true;
#else
constexpr bool optimised = false;
#endif

/// A count, the right one, and those of two mistakes: testing at the cells' corners, and dart
/// numbers truncated to 32 bits.
struct Counted {
  double hits, expected, at_corner, number_cut;
  std::uint64_t key;
};

Counted count(std::int64_t first, std::int64_t n) {
  const Answer rows =
      probe("Lab 2.5 count", {.n = n, .numbers = {{"first", static_cast<double>(first)}}}, {});
  constexpr std::int64_t words = std::int64_t{1} << 32;
  const auto expected = static_cast<double>(hits_of(rows.seed, first, n));
  return {rows.at(0, 0), expected, static_cast<double>(hits_of(rows.seed, first, n, 0.0)),
          first < words ? expected : static_cast<double>(hits_of(rows.seed, first % words, n)),
          rows.seed};
}

/// True if the count for a million darts is right.
bool million_right() {
  const Counted million = count(0, 1'048'576);
  return million.hits == million.expected;
}

/// Adds the number of darts that count as hits if the sum of both squares is an int: it overflows
/// to negative numbers, which are no hits. Once with the squares of x and y, once with those of the
/// cell's centre.
void add_sums_in_int(Suspects& suspects, std::uint64_t key, std::int64_t first, std::int64_t n) {
  double by_corner = 0, by_centre = 0;
  for (std::int64_t i = first; i < first + n; ++i) {
    const std::uint32_t dart = dart_of(key, i), x = dart & 0xFFFF, y = dart >> 16;
    by_corner += (x * x + y * y) >> 31 == 0 ? 1 : 0;
    by_centre += (x * (x + 1) + y * (y + 1)) >> 31 == 0 ? 1 : 0;
  }
  suspects.push_back({by_corner, cut_squares});
  suspects.push_back({by_centre, cut_squares});
}

/// Adds the counts of counters of 8 and 16 bits.
void add_small_counters(Suspects& suspects, double hits) {
  for (const double range : {256.0, 65536.0}) {
    const double rest = std::fmod(hits, range);
    suspects.push_back({rest, small_counter});
    if (rest >= range / 2) suspects.push_back({rest - range, small_counter});
  }
}

/// No hits at all: for the first darts the squares are the cause; far along the list, if those are
/// right, the numbers.
void add_none(Suspects& suspects, std::int64_t first) {
  if (first < std::int64_t{1} << 32) {
    suspects.push_back({0, cut_squares});
  } else if (million_right()) {
    suspects.push_back({0, cut_number});
  }
}

void judge_count(std::int64_t first, std::int64_t n) {
  const Counted found = count(first, n);
  const auto darts = static_cast<double>(n);
  Suspects suspects;
  if (found.expected != found.at_corner) suspects.push_back({found.at_corner, corner});
  if (n > 20'000'000) suspects.push_back({16777216, fast_float_counter});
  if (found.number_cut != found.expected) suspects.push_back({found.number_cut, cut_number});
  suspects.push_back({darts, cut_squares});
  if (found.hits != found.expected) {
    add_sums_in_int(suspects, found.key, first, n);
    add_small_counters(suspects, found.expected);
    add_none(suspects, first);
  }
  judge(equals(fmt::format("the hits among {} from number {}", counted(darts, "dart"),
                           number_in_report(static_cast<double>(first))),
               found.hits, found.expected, 0, suspects));
}

/// The hits of every range of up to n darts that begins at darts 0 ... n, in the order of the
/// probe.
std::vector<double> hits_of_ranges(std::uint64_t key, std::int64_t most) {
  std::vector<double> hits;
  for (std::int64_t first = 0; first <= most; ++first) {
    for (std::int64_t n = 0; n <= most; ++n)
      hits.push_back(static_cast<double>(hits_of(key, first, n)));
  }
  return hits;
}

/// The time of a wrong count means nothing. The tests of the count report what is wrong with it.
constexpr const char* no_time_of_wrong_counts = "not judged: the count is wrong";

constexpr std::int64_t timed_darts = 1'000'000;

/// Both loops counted correctly in every round, so neither skipped one.
Verdict counts_while_timed(const Answer& rows) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const auto round = static_cast<std::int64_t>(i);
    const std::int64_t plain = plain_loop(rows.seed + i, timed_darts);
    const std::int64_t fast = hits_of(rows.seed, round * timed_darts, timed_darts);
    const bool right =
        rows.at(i, 2) == static_cast<double>(plain) && rows.at(i, 3) == static_cast<double>(fast);
    wrong += right ? 0 : 1;
  }
  return holds("the hits counted while the time was taken", wrong == 0,
               fmt::format("{} of {} counts wrong", wrong, rows.count()), "all right", {});
}

/// The times are claimed by the worker. On one thread their sum cannot exceed the worker's
/// lifetime.
Verdict times_fit(const Answer& rows) {
  double sum = 0;
  bool positive = true;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    sum += rows.at(i, 0) + rows.at(i, 1);
    positive = positive && rows.at(i, 0) > 0 && rows.at(i, 1) > 0;
  }
  return holds("the times taken, together", positive && sum <= rows.seconds,
               positive ? fmt::format("{:.3g} s", sum) : "none, or less than none, for a round",
               fmt::format("at most the {:.3g} s that the program ran", rows.seconds), {});
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The processor seconds of all workers so far, according to the kernel, not to them.
double workers_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The speed of a dart relative to the plain loop, by clocks that no worker can manipulate: the
/// kernel's, for a worker that counts many darts, minus that of one that counts none, compared with
/// our own loop. The best of three tries; 0 if a count is wrong.
double ratio_from_outside() {
  constexpr std::int64_t n = 16'000'000;
  double most_plain = 0, least_none = 1e9, least_many = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = workers_seconds();
    const Counted none = count(0, 16);
    const double middle = workers_seconds();
    const Counted many = count(0, n);
    const double end = workers_seconds();
    if (none.hits != none.expected || many.hits != many.expected) return 0;
    least_none = std::min(least_none, middle - start);
    least_many = std::min(least_many, end - middle);
    const double before = thread_seconds();
    const std::int64_t hits = plain_loop(static_cast<std::uint64_t>(i), n / 16);
    if (hits > 0) most_plain = std::max(most_plain, 16 * (thread_seconds() - before));
  }
  return most_plain / std::max(least_many - least_none, 1e-6);
}

}  // namespace

// Among a million darts about 15 hit by their cell's corner and miss by its centre.
TEST_CASE("Lab 2.5: the hits among a million darts are counted exactly", "[lab02][ex5]") {
  judge_count(0, 1'048'576);
  judge_count(1'048'576, 1'048'576);
}

TEST_CASE("Lab 2.5: far along the list, and of many darts, the count is exact", "[lab02][ex5]") {
  judge_count(1'099'511'627'776, 1'048'576);  // 2^40
  judge_count(0, 25'165'824);                 // 19.8 million hits, more than a float counts
}

TEST_CASE("Lab 2.5: any range counts, whatever dart it begins and ends with", "[lab02][ex5]") {
  constexpr std::size_t n = 70;
  const Answer rows = probe("Lab 2.5 ranges", {.n = n}, {.rows = (n + 1) * (n + 1)});
  const std::vector<double> expected = hits_of_ranges(rows.seed, n);
  const bool whole_right = million_right();
  std::size_t wrong = 0, first_wrong = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (rows.at(i, 0) == expected[i]) continue;
    if (wrong++ == 0) first_wrong = i;
  }
  std::string measured = "all right";
  if (wrong > 0) {
    const auto darts = static_cast<double>(first_wrong % (n + 1));
    measured = fmt::format("{} wrong; the first: of {} from number {} there are {}, not {}",
                           number_in_report(static_cast<double>(wrong)), counted(darts, "dart"),
                           first_wrong / (n + 1), counted(rows.at(first_wrong, 0), "hit"),
                           number_in_report(expected[first_wrong]));
  }
  std::vector<Diagnosis> diagnoses;
  if (whole_right) diagnoses.push_back(ragged);
  judge(holds(fmt::format("the hits of all ranges within the first {} darts", 2 * n), wrong == 0,
              measured, "all right", diagnoses));
}

// The least speed-up required. Reference values (GCC 12, Zen 4): the contract written down plainly
// is 2.3 times as fast as the plain loop; with each word computed once 2.9 (64-bit integers) to 3.7
// times, with 32 bits 4.6, the solution 7. Uses the least of eight times each, since disturbances
// only make a loop slower. Sanitizers and unoptimised builds change the ratio, so it is not judged
// there.
TEST_CASE("Lab 2.5: a dart takes far less time than one by std::mt19937",
          "[lab02][ex5][efficiency]") {
  constexpr std::size_t repetitions = 8;
  const Answer rows =
      probe("Lab 2.5 speed", {.n = timed_darts, .numbers = {{"repetitions", double{repetitions}}}},
            {.rows = repetitions, .columns = 4});
  const Verdict counts = counts_while_timed(rows);
  if (!counts.passed && !million_right()) return leave_unjudged(no_time_of_wrong_counts);
  judge(counts);
  judge(times_fit(rows));
  const std::vector<double> plain = column(rows, 0);
  const std::vector<double> fast = column(rows, 1);
  const double ratio =
      *std::min_element(plain.begin(), plain.end()) / *std::min_element(fast.begin(), fast.end());
  const bool judged = optimised && !address_sanitizer();
  const bool fast_enough = ratio >= 2.5 || !judged;
  judge(holds("darts a second, compared with std::mt19937", fast_enough,
              fmt::format("{:.2g} times as many", ratio),
              judged ? "at least 2.5 times as many" : "not judged in this build",
              slow_if(!fast_enough && million_right())));
}

// The times above are taken in the worker, which could forge them. Measured from outside they are
// coarser, so 1.5 is enough here.
TEST_CASE("Lab 2.5: the time that the program takes as a whole tells the same",
          "[lab02][ex5][efficiency]") {
  const bool judged = optimised && !address_sanitizer();
  const double ratio = judged ? ratio_from_outside() : 0;
  const bool right = ratio > 0 || !judged;
  if (!right && !million_right()) return leave_unjudged(no_time_of_wrong_counts);
  judge(is_so("the hits counted while the time was taken", right, "some wrong", "all right"));
  if (!right) return;
  judge(holds("darts a second of the whole program, compared with std::mt19937",
              ratio >= 1.5 || !judged, fmt::format("{:.2g} times as many", ratio),
              judged ? "at least 1.5 times as many" : "not judged in this build", {slow}));
}
