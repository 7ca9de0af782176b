#pragma once

#include "course/report/table.h"
#include "grader/calibrate/power.h"

#include <vector>

namespace carlo::grader {

/// Everything that calibration found.
struct Findings {
  std::vector<LabFinding> labs;
  std::vector<MistakeFinding> mistakes;
  std::vector<PowerFinding> power;
};

Findings findings(const std::vector<Judged>& judged);

/// A lab a row: how often right solutions fail, and what a grading costs.
Table rates_table(const Findings& findings);
/// A lab a row: whether the p-values of right solutions are uniform.
Table uniformity_table(const Findings& findings);
/// A comparison a row: those whose p-values are not uniform, or all.
Table behaviour_table(const Findings& findings, bool all);
/// A lab a row: how many mistakes are caught and named, each time and often.
Table catch_table(const Findings& findings);
/// A mistake a row: those that were missed, not named or close to that, or all.
Table mistakes_table(const Findings& findings, bool all);
/// A comparison a row: what it claims to see, and the weakest mistake that it caught.
Table power_table(const Findings& findings);
/// A lab a row: how often effects as large as claimed were caught.
Table claims_table(const Findings& findings);

}  // namespace carlo::grader
