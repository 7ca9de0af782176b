#pragma once

#include "course/report/table.h"
#include "grader/calibrate/power.h"

#include <vector>

namespace carlo::grader {

/// All results of calibration.
struct Findings {
  std::vector<LabFinding> labs;
  std::vector<MistakeFinding> mistakes;
  std::vector<PowerFinding> power;
};

Findings findings(const std::vector<Judged>& judged);

/// One row per lab: how often correct solutions fail, and what a grading costs.
Table rates_table(const Findings& findings);
/// One row per lab: whether the p-values of correct solutions are uniform.
Table uniformity_table(const Findings& findings);
/// One row per comparison: those whose p-values are not uniform, or all.
Table behaviour_table(const Findings& findings, bool all);
/// One row per lab: how many mistakes are caught and named, always and often.
Table catch_table(const Findings& findings);
/// One row per mistake: those missed, unnamed or close to that, or all.
Table mistakes_table(const Findings& findings, bool all);
/// One row per comparison: the effect that it claims to detect, and the weakest mistake that it
/// caught.
Table power_table(const Findings& findings);
/// One row per lab: how often effects as large as claimed were caught.
Table claims_table(const Findings& findings);

}  // namespace carlo::grader
