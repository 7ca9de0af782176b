#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

struct LabGrade {
  LabResult result;  ///< if not judged: every exercise with the reason as its status
  std::optional<Status> unjudged = {};  ///< why there are no verdicts; empty if there are
  std::string note;                     ///< for the student: the reason, or files left out
  std::string compiler;                 ///< the compiler's messages, warnings too
  std::string report;                   ///< the judge's, for the student
  double compile_seconds = 0, judge_seconds = 0;
  std::size_t compile_peak_bytes = 0, judge_peak_bytes = 0;

  /// Returns the sum; none if it is unknown because the grader failed.
  std::optional<double> points() const;
  int max() const { return result.possible(); }
};

/// Says why a lab was not judged: "does not compile".
std::string in_words(Status unjudged);

/// Returns "judged", or the name of the reason why not.
std::string state_of(const LabGrade& lab);

/// Returns the marks of one exercise; none if the grader failed.
std::optional<double> points_of(const ExerciseResult& exercise);

/// Says, for the student, what keeps an exercise of this lab from all its points, without colours.
std::string text_of(const LabGrade& lab, const ExerciseResult& exercise);

/// Everything about the grading of one submission.
struct Record {
  std::string name;
  std::string key;  ///< identifies what the marks depend on: equal keys, equal marks
  std::vector<std::string> ignored;
  std::vector<LabGrade> labs;
  std::string source = {};  ///< where it was found; not kept in record.json

  std::optional<double> points() const;
  int max() const;
  bool complete() const { return points().has_value(); }
  /// Returns "graded", or says what was not: "lab 2 not submitted; lab 3 does not compile".
  std::string status() const;
};

/// Makes the grade of a lab that was not judged, and why: no points, or no marks at all if the
/// grader failed.
LabGrade unjudged(const Lab& lab, Status why, const std::string& note);

/// Makes the grade of a judged lab from the judge's verdicts. Throws Error if they are not of this
/// lab.
LabGrade judged(const Lab& lab, const LabResult& result);

/// Throws Error if the judge's result is not of this exercise.
void check_result(const Exercise& exercise, const ExerciseResult& result);

std::string to_json(const Record& record);
/// Throws Error if the text is not a record.
Record record_from_json(const std::string& text);

/// Returns the record in a submission's output folder; none if it is missing or corrupt.
std::optional<Record> load_record(const std::filesystem::path& folder);

}  // namespace carlo::grader
