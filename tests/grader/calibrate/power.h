#pragma once

#include "grader/calibrate/findings.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// One comparison and one mistake that it looked at.
struct Sight {
  std::string mistake;
  double effect = 0;  ///< its mean size
  std::size_t runs = 0, caught = 0;
};

/// How much one comparison sees. Both lists come from runs of mistakes in its exercise.
struct PowerFinding {
  int lab = 0;
  ComparisonFinding comparison;
  std::size_t mistakes_caught = 0;
  Sight weakest;  ///< of those caught at least once, the one with the least effect
  std::size_t runs_in_sight = 0, caught_in_sight = 0;  ///< of effects >= resolution
};

std::vector<PowerFinding> power_findings(const LabFinding& lab,
                                         const std::vector<Judged>& mistakes);

}  // namespace carlo::grader
