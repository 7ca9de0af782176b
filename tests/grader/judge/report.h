#pragma once

#include "grader/judge/results.h"

#include <string>

namespace carlo::grader {

/// The report for the student, in colour where stdout shows it. `verbose`: every test and every
/// comparison, those that passed too.
std::string report_text(const LabResult& result, bool verbose = false);

/// For the student: what keeps one exercise from all its points; empty when it passed. In colour as
/// above.
std::string shortfall(const ExerciseResult& result, const LabResult& lab);

/// The same for programs: the lab, the seed, and for each exercise tag, points, max, status,
/// aspects, diagnosis ids, message, text for the student and p-values; its tests with their
/// aspects; and what details.h and comparisons.h add.
std::string report_json(const LabResult& result);

}  // namespace carlo::grader
