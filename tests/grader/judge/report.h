#pragma once

#include "grader/judge/results.h"

#include <string>

namespace carlo::grader {

/// The report for the student, in colour where stdout shows it. `verbose`: every test and every
/// comparison, those that passed too.
std::string report_text(const LabResult& result, bool verbose = false);

/// The same for programs: the lab, the seed, and for each exercise tag, points, max, status,
/// diagnosis ids, message and p-values; and what details.h adds.
std::string report_json(const LabResult& result);

}  // namespace carlo::grader
