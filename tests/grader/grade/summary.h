#pragma once

#include "grader/grade/class.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns a line about a finished submission.
std::string line_of(const Finished& finished);

/// Writes class.csv, timing.csv and, for more than one submission, class.html, and prints
/// what the class cost and what needs attention. Returns 0. Throws Error if marks are missing, or
/// if somebody has to check names or files that are not submissions.
int finish_class(const std::vector<CourseLab>& labs, const std::vector<Record>& records,
                 const Submissions& submissions, const std::filesystem::path& out, bool names);

}  // namespace carlo::grader
