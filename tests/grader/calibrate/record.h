#pragma once

#include "course/verdict/verdict.h"
#include "grader/calibrate/plan.h"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace carlo::grader {

/// One run of a judge.
struct Record {
  JobKey key;
  int exit_code = 0;
  double cpu_seconds = 0;  ///< of the judge and its workers together
  double megabytes = 0;    ///< the largest resident set of any of them
  LabResult result = {};
};

/// The name of a comparison: exercise, test, what, and its index among those that share these.
using ComparisonName = std::tuple<std::string, std::string, std::string, int>;

/// A statistical comparison of one judgement. Unknown values, or those that are not numbers, are
/// NaN.
struct Comparison {
  ComparisonName name;
  double p;
  Effect effect;
};
std::vector<Comparison> comparisons(const Record& record);

/// Returns how many exact comparisons of an exercise failed, plus the tests that ended without any.
int exact_failures(const ExerciseResult& exercise);

/// Removes what calibration does not need: figures, printed text, exact comparisons that passed.
LabResult kept_of(LabResult result);

/// Returns one line of the store, without its line end.
std::string to_line(const Record& record);
/// Parses a line; nothing if to_line() did not write it, e.g. if it was cut short.
std::optional<Record> record_from(const std::string& line);

}  // namespace carlo::grader
