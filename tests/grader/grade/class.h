#pragma once

#include "grader/grade/judging.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace carlo::grader {

/// The result of one submission.
struct Finished {
  Record record;
  bool again = false;  ///< its marks existed already
  double seconds = 0;
};

/// Grades submissions, `workers` at a time, each in its own process, and writes their files into
/// folders of their names below `out`. A submission whose record exists already, and follows from
/// the same files, grader and secret, is left as it is. Those that could not be graded are retried
/// at the end, an eighth as many at a time. `tell` is called as each is done. Returns the records
/// in the order of `sources`.
std::vector<Record> grade_class(const Course& course, const std::vector<Source>& sources,
                                const std::filesystem::path& out, int workers,
                                const std::function<void(const Finished&)>& tell);

/// Returns what exists already: for each submission the record with its marks, in the order of
/// `sources`, and nothing for one that is still to be graded. Grades and writes nothing.
std::vector<std::optional<Record>> survey_class(const Course& course,
                                                const std::vector<Source>& sources,
                                                const std::filesystem::path& out, int workers);

/// Writes the exercise files of each submission to `to`/of_NAME.json, as similarity.mjs takes them;
/// none for one that cannot be read.
void write_texts(const Course& course, const std::vector<Source>& sources,
                 const std::filesystem::path& to, int workers);

}  // namespace carlo::grader
