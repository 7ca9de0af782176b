#pragma once

#include "course/verdict/verdict.h"

#include <vector>

namespace carlo::grader {

// What checks name as the grader's.
using carlo::Diagnosis;
using carlo::Verdict;

/// What a typical mistake would have given in place of the right value.
struct Suspect {
  double value;
  Diagnosis diagnosis;
};
using Suspects = std::vector<Suspect>;

}  // namespace carlo::grader
