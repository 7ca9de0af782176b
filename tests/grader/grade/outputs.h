#pragma once

#include "grader/grade/record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// What Gradescope reads: a test for each exercise. A record without all marks has no score, so
/// that it is seen as the failure that it is.
std::string gradescope_json(const Record& record);

/// JUnit's XML: a suite for each lab, a case for each exercise. What could not be judged is an
/// error, what lost points a failure.
std::string junit_xml(const Record& record);

/// What the student reads.
std::string report_text(const Record& record);

/// One line a submission, sorted by name: points of each exercise, sums of the labs, total, the
/// most there is, status. Without marks a cell is empty. Nothing in it depends on when or how fast
/// it was made.
std::string class_csv(std::vector<Record> records);

/// One line a submission and lab: seconds and peak memory of compiling and judging.
std::string timing_csv(std::vector<Record> records);

/// Writes all files of one submission into its folder, the record last: where it is, all are.
void write_outputs(const Record& record, const std::filesystem::path& folder);

}  // namespace carlo::grader
