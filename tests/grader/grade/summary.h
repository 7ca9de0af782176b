#pragma once

#include "grader/grade/class.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// What is told of a submission that is done, in a line.
std::string line_of(const Finished& finished);

/// Writes class.csv and timing.csv, and tells what the class cost and where to look. Returns 0.
/// Throws Error when marks are missing, or when somebody has to look at names or at files that are
/// no submissions.
int finish_class(const std::vector<CourseLab>& labs, const std::vector<Record>& records,
                 const Submissions& submissions, const std::filesystem::path& out);

}  // namespace carlo::grader
