#pragma once

#include "grader/grade/class.h"
#include "grader/grade/class_page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns a line about a finished submission.
std::string line_of(const Finished& finished);

/// Writes class.csv, timing.csv and, for more than one submission, class.html, and prints
/// what the class cost.
void write_class(const std::vector<CourseLab>& labs, const std::vector<Record>& records,
                 const std::filesystem::path& out, const ClassWords& words);

/// Prints what needs attention. Throws Error if marks are missing, or if somebody has to check
/// names or files that are not submissions.
void check_class(const std::vector<Record>& records, const Submissions& submissions);

}  // namespace carlo::grader
