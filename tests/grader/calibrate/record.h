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

/// A comparison's name: exercise, test, what, and of several that agree in these which one it is.
using ComparisonName = std::tuple<std::string, std::string, std::string, int>;

/// A statistical comparison of one judgement. What is not known, or no number, is NaN.
struct Comparison {
  ComparisonName name;
  double p;
  Effect effect;
};
std::vector<Comparison> comparisons(const Record& record);

/// How many exact comparisons of an exercise failed, and tests that came to none.
int exact_failures(const ExerciseResult& exercise);

/// The same without what calibration does not need: figures, printed words, what passed exactly.
LabResult kept_of(LabResult result);

/// One line of the store, without its end.
std::string to_line(const Record& record);
/// Nothing for a line that to_line() has not written, such as one that was cut short.
std::optional<Record> record_from(const std::string& line);

}  // namespace carlo::grader
