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

/// One comparison of a lab, over all gradings of its solution.
struct ComparisonFinding {
  ComparisonName name;
  Uniformity uniformity;
  double resolution = 0;  ///< NaN where the comparison does not tell
  std::string unit;
  std::vector<double> p_values;
  double spread = 1;  ///< Effect's, of the first grading

  /// What its p-values are, at this level of both tests; where theory's variance is a bound,
  /// cautious also as long as there are too few of them to show it.
  Behaviour behaviour(double level) const;
  /// Why its p-values are larger than uniform ones; empty where that is not known.
  std::string caution() const;
};

/// What the gradings of one solution say.
struct LabFinding {
  int lab = 0;
  std::size_t gradings = 0, false_failures = 0;
  std::vector<ComparisonFinding> comparisons;
  Uniformity all;                     ///< all p-values together
  Uniformity without_cautious;        ///< without the comparisons that are cautious by themselves
  std::vector<std::string> failures;  ///< of each false one: the seed and what the judge said
  double median_seconds = 0, worst_seconds = 0, worst_megabytes = 0;
};

/// Comparisons of solutions and labs are looked at together: at this level over all of them.
constexpr double uniformity_level = 1e-3;

LabFinding lab_finding(const Judged& solution);

/// What the runs of one mistake say.
struct MistakeFinding {
  Subject subject;
  std::size_t runs = 0, caught = 0, named = 0;
  std::size_t alone = 0;  ///< named, and no other diagnosis beside it
  /// Orders of magnitude by which p lay below the level, in the run where that was least; infinite
  /// where each run failed a comparison that knows no chance. Negative: it was missed.
  double margin = 0;
  std::string first_missed;  ///< the seed and the status of the first run that was not as expected
};

MistakeFinding mistake_finding(const Judged& mistake);

}  // namespace carlo::grader
