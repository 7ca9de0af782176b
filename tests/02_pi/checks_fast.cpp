// Checks of exercise 2.5. The darts are given by the contract, so the count has one right value.

#include "grader/judge/judge.h"
#include "grader/judge/process.h"

#include <algorithm>

using namespace carlo::grader;

namespace {

const Diagnosis corner{"corner-of-the-cell",
                       "a dart lies at the centre of its cell, half a step from (x, y): taken at "
                       "the corner, a few darts too many hit."};
const Diagnosis float_counter{"float-counter",
                              "the hits stop at 16777216 = 2^24: a float cannot count further."};
const Diagnosis ragged{"range-not-in-whole-rounds",
                       "ranges of an even begin and a round length are right, others are not: the "
                       "darts before the first whole word or after the last whole round."};
const Diagnosis slow{"not-faster", "the count is right; now make it fast (./carlo hint 2.5)."};

Rows count(double first, double n) {
  return probe("Lab 2.5 count", {.n = static_cast<std::int64_t>(n), .numbers = {{"first", first}}},
               {.columns = 3});
}

void judge_count(double first, double n) {
  const Rows rows = count(first, n);
  Suspects suspects;
  if (rows.at(0, 1) != rows.at(0, 2)) suspects.push_back({rows.at(0, 2), corner});
  if (n > 2e7) suspects.push_back({16777216, float_counter});
  judge(equals(fmt::format("the hits among {:g} darts from number {:.0f}", n, first), rows.at(0, 0),
               rows.at(0, 1), 0, suspects));
}

}  // namespace

// A million darts hold some 15 that hit by their cell's corner and miss by its centre.
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
  const Rows rows = probe("Lab 2.5 ranges", {.n = n}, {.rows = (n + 1) * (n + 1), .columns = 2});
  const Rows whole = count(0, 1'048'576);
  const bool whole_right = whole.at(0, 0) == whole.at(0, 1);
  std::size_t wrong = 0, first_wrong = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (rows.at(i, 0) == rows.at(i, 1)) continue;
    if (wrong++ == 0) first_wrong = i;
  }
  std::string measured = "all right";
  if (wrong > 0) {
    measured = fmt::format("{} wrong; the first: {} darts from number {} have {:g} hits, not {:g}",
                           wrong, first_wrong % (n + 1), first_wrong / (n + 1),
                           rows.at(first_wrong, 0), rows.at(first_wrong, 1));
  }
  std::vector<Diagnosis> diagnoses;
  if (whole_right) diagnoses.push_back(ragged);
  judge(holds(fmt::format("the hits of all ranges within the first {} darts", 2 * n), wrong == 0,
              measured, "all right", diagnoses));
}

// The least of eight times each: what disturbs a loop makes it slower, never faster. Sanitizers and
// builds without optimisation change the ratio, and it is not judged there.
TEST_CASE("Lab 2.5: a dart takes at most a third of a dart by std::mt19937",
          "[lab02][ex5][efficiency]") {
  constexpr std::size_t repetitions = 8;
  const Rows rows =
      probe("Lab 2.5 speed", {.n = 1'000'000, .numbers = {{"repetitions", double{repetitions}}}},
            {.rows = repetitions, .columns = 5});
  const std::vector<double> plain = column(rows, 0);
  const std::vector<double> fast = column(rows, 1);
  const double ratio =
      *std::min_element(plain.begin(), plain.end()) / *std::min_element(fast.begin(), fast.end());
  const bool judged = rows.at(0, 4) == 1 && !address_sanitizer();
  judge(holds("darts a second, compared with std::mt19937", ratio >= 3 || !judged,
              fmt::format("{:.2g} times as many", ratio),
              judged ? "at least 3 times as many" : "not judged in this build", {slow}));
}
