#pragma once

#include "grader/judge/process.h"

#include <string>

namespace carlo::grader {

/// The first place in a lab's files that a sanitizer's report names, as
/// "labs/01_integration/integration.cpp:27"; empty when there is none.
std::string place_in(const std::string& said);

/// The same where a sanitizer has reported anything at all.
std::string place_in_report(const std::string& said);

/// Whether a sanitizer has reported something in what a program said.
bool has_report(const std::string& said);

/// What a program said itself: without the library's own words before an abort and a sanitizer's
/// report, of which crash_cause() tells what matters.
std::string without_reports(const std::string& said);

/// Why a worker crashed, for a student: what the library's checks or a sanitizer said before its
/// end, or the signal; and where, if the report names a line of the lab.
std::string crash_cause(const Outcome& outcome);

}  // namespace carlo::grader
