#pragma once

#include "grader/judge/effect.h"
#include "grader/judge/figure.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// A typical mistake that the values fit.
struct Diagnosis {
  std::string id;        ///< "variance-divided-by-n"
  std::string sentence;  ///< for the student: what it looks like
};

/// What a typical mistake would have given in place of the right value.
struct Suspect {
  double value;
  Diagnosis diagnosis;
};
using Suspects = std::vector<Suspect>;

/// The conclusion of one comparison.
struct Verdict {
  bool passed = false;
  std::string what;  ///< the thing compared, in words
  std::string measured;
  std::string expected;
  std::string certainty;             ///< how sure: z, p; empty for exact comparisons
  std::optional<double> p;           ///< for statistical ones: its p-value under a right solution
  std::vector<Diagnosis> diagnoses;  ///< that the values fit
  std::optional<Effect> effect = std::nullopt;  ///< beside p: what calibration compares
  std::optional<Figure> figure = std::nullopt;  ///< of a failed one, where it helps
  std::vector<Diagnosis> looked_for = {};  ///< of a failed one: those, and others that do not fit
};

}  // namespace carlo::grader
