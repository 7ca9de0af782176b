#pragma once

#include "grader/calibrate/findings.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// One comparison and one mistake that it measured.
struct Sight {
  std::string mistake;
  double effect = 0;  ///< mean size of the effect
  std::size_t runs = 0, caught = 0;
};

/// The power of one comparison. Both lists come from runs of mistakes in its exercise.
struct PowerFinding {
  int lab = 0;
  ComparisonFinding comparison;
  std::size_t mistakes_caught = 0;
  Sight weakest;  ///< the one with the least effect, of those caught at least once
  std::size_t runs_in_sight = 0, caught_in_sight = 0;  ///< runs with effects >= resolution
};

std::vector<PowerFinding> power_findings(const LabFinding& lab,
                                         const std::vector<Judged>& mistakes);

}  // namespace carlo::grader
