#pragma once

#include "grader/calibrate/plan.h"

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carlo::grader {

/// One statistical comparison of one judgement, as judge/comparisons.h writes it. What is not known
/// or no number is NaN.
struct Comparison {
  std::string test, what;
  double p = 0, effect = 0, resolution = 0;
  std::string unit;
  double spread = 1;
};

/// What the judge said of one exercise.
struct Judgement {
  std::string tag, status, message;
  std::vector<std::string> diagnoses;
  std::vector<Comparison> comparisons;
  int exact_failures = 0;
};

/// One run of a judge.
struct Record {
  JobKey key;
  int exit_code = 0;
  double cpu_seconds = 0;  ///< of the judge and its workers together
  double megabytes = 0;    ///< the largest resident set of any of them
  std::vector<Judgement> exercises;
};

/// A comparison's name: exercise, test, what, and of several that agree in these which one it is.
using ComparisonName = std::tuple<std::string, std::string, std::string, int>;
std::vector<std::pair<ComparisonName, const Comparison*>> comparisons(const Record& record);

/// One line of the store, without its end.
std::string to_line(const Record& record);
/// Nothing for a line that to_line() has not written, such as one that was cut short.
std::optional<Record> record_from(const std::string& line);

/// The exercises in the verdicts that a judge wrote (--json). Throws Error.
std::vector<Judgement> judgements_from(const std::string& verdicts);

}  // namespace carlo::grader
