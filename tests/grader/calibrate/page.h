#pragma once

#include "course/report/page.h"
#include "grader/calibrate/tables.h"

#include <string>

namespace carlo::grader {

/// No false failure, every mistake caught in every run, and no p-values that are too small.
bool sound(const Findings& findings);

/// What matters, for the console: whole labs, and what needs a look.
std::string report_text(const Findings& findings);
/// All tables, for programs.
std::string report_json(const Findings& findings);
/// All tables with what they say, and the distribution of the p-values.
Page report_page(const Findings& findings);

}  // namespace carlo::grader
