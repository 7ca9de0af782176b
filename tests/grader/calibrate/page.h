#pragma once

#include "course/report/page.h"
#include "grader/calibrate/tables.h"

#include <string>

namespace carlo::grader {

/// Returns whether there is no false failure, every mistake is caught in every run, and no p-values
/// are too small.
bool sound(const Findings& findings);

/// Returns the summary for the console: whole labs, and what needs attention.
std::string report_text(const Findings& findings);
/// Returns all tables, for programs.
std::string report_json(const Findings& findings);
/// Returns all tables with explanations, and the distribution of the p-values.
Page report_page(const Findings& findings);

}  // namespace carlo::grader
