#pragma once

#include "grader/grade/record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns Gradescope's JSON: a test for each exercise. A record without all marks has no score, so
/// that it appears as a failure.
std::string gradescope_json(const Record& record);

/// Returns JUnit XML: a suite for each lab, a case for each exercise. What could not be judged is
/// an error, what lost points a failure.
std::string junit_xml(const Record& record);

/// Returns the student's report.
std::string report_text(const Record& record);

/// Returns one line per submission, sorted by name: points of each exercise, sums of the labs,
/// total, maximum, status. Without marks a cell is empty. Independent of when or how fast it was
/// made.
std::string class_csv(std::vector<Record> records);

/// Returns one line per submission and lab: seconds and peak memory of compiling and judging.
std::string timing_csv(std::vector<Record> records);

/// Writes all files of one submission into its folder, the record last: if it exists, all do.
void write_outputs(const Record& record, const std::filesystem::path& folder);

}  // namespace carlo::grader
