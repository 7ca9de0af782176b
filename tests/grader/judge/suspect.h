#pragma once

#include "course/verdict/verdict.h"

#include <vector>

namespace carlo::grader {

// Lets checks name it as the grader's.
using carlo::Diagnosis;
using carlo::Verdict;

/// The value that a typical mistake would give instead of the right one.
struct Suspect {
  double value;
  Diagnosis diagnosis;
};
using Suspects = std::vector<Suspect>;

}  // namespace carlo::grader
