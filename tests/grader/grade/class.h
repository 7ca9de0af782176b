#pragma once

#include "grader/grade/judging.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace carlo::grader {

/// What one submission came to.
struct Finished {
  Record record;
  bool again = false;  ///< marks that were there already
  double seconds = 0;
};

/// Grades submissions, `workers` at a time, each in a process of its own, and writes their files
/// into folders of their names below `out`. One whose record is there already, and follows from the
/// same submission, grader and secret, is left as it is. Those that could not be graded are tried
/// again in the end, an eighth as many at a time. `tell` hears of each as it is done.
/// Returns the records in the order of `sources`.
std::vector<Record> grade_class(const Course& course, const std::vector<Source>& sources,
                                const std::filesystem::path& out, int workers,
                                const std::function<void(const Finished&)>& tell);

/// What is there already: of each submission the record with its marks, in the order of `sources`,
/// and nothing of one that is still to be graded. Grades and writes nothing.
std::vector<std::optional<Record>> survey_class(const Course& course,
                                                const std::vector<Source>& sources,
                                                const std::filesystem::path& out, int workers);

}  // namespace carlo::grader
