#pragma once

#include "grader/judge/results.h"

#include <nlohmann/json_fwd.hpp>

namespace carlo::grader {

/// Adds to each exercise of the report (report.h) what calibration needs: "comparisons", all that
/// have a p-value, passed or not (test, what, p, and where known effect, resolution, unit and
/// spread), and "exact_failures", how many of the others failed, tests without values among them.
void add_comparisons(nlohmann::json& document, const LabResult& result);

}  // namespace carlo::grader
