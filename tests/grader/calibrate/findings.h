#pragma once

#include "grader/calibrate/plan.h"
#include "grader/calibrate/rates.h"
#include "grader/calibrate/record.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// All records of one subject.
struct Judged {
  Subject subject;
  std::vector<const Record*> records;
};

/// The results of one comparison of a lab, over all gradings of its solution.
struct ComparisonFinding {
  ComparisonName name;
  Uniformity uniformity;
  double resolution = 0;  ///< NaN if the comparison has none
  std::string unit;
  std::vector<double> p_values;
  double spread = 1;  ///< Effect's, of the first grading

  /// Classifies its p-values, at this level for both tests; where theory's variance is a bound,
  /// cautious even while there are too few of them to show it.
  Behaviour behaviour(double level) const;
  /// Returns why its p-values are larger than uniform ones; empty if unknown.
  std::string caution() const;
};

/// The results of the gradings of one solution.
struct LabFinding {
  int lab = 0;
  std::size_t gradings = 0, false_failures = 0;
  std::vector<ComparisonFinding> comparisons;
  Uniformity all;                     ///< all p-values together
  Uniformity without_cautious;        ///< without comparisons that are cautious by themselves
  std::vector<std::string> failures;  ///< for each false failure: the seed and the judge's message
  double median_seconds = 0, worst_seconds = 0, worst_megabytes = 0;
};

/// The level over all comparisons of all solutions and labs together.
constexpr double uniformity_level = 1e-3;

LabFinding lab_finding(const Judged& solution);

/// The results of the runs of one mistake.
struct MistakeFinding {
  Subject subject;
  std::size_t runs = 0, caught = 0, named = 0;
  std::size_t alone = 0;  ///< runs in which no other diagnosis was named beside it
  /// Orders of magnitude by which p lay below the level, in the run where that was least; infinite
  /// if every run failed an exact comparison. Negative: it was missed.
  double margin = 0;
  std::string first_missed;  ///< the seed and status of the first run that was not as expected
};

MistakeFinding mistake_finding(const Judged& mistake);

}  // namespace carlo::grader
