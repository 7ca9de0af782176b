#pragma once

#include "grader/judge/process.h"

#include <string>

namespace carlo::grader {

/// Returns the first place in a lab's files that a sanitizer's report names, as
/// "labs/01_integration/integration.cpp:27"; empty if there is none.
std::string place_in(const std::string& said);

/// The same, but only if a sanitizer has reported anything at all.
std::string place_in_report(const std::string& said);

/// Returns whether a program's output contains a sanitizer's report.
bool has_report(const std::string& said);

/// Returns the program's own output, without the library's messages before an abort and a
/// sanitizer's report, which crash_cause() summarises.
std::string without_reports(const std::string& said);

/// Says, for a student, why a worker crashed: what the library's checks or a sanitizer said before
/// its end, or the signal; and where, if the report names a line of the lab.
std::string crash_cause(const Outcome& outcome);

}  // namespace carlo::grader
