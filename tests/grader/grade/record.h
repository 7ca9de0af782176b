#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

struct LabGrade {
  LabResult result;  ///< of one that was not judged: every exercise with the reason as its status
  std::optional<Status> unjudged = {};  ///< why there are no verdicts; nothing: there are
  std::string note;                     ///< for the student: why, or files left out
  std::string compiler;                 ///< the compiler's messages, warnings too
  std::string report;                   ///< the judge's, for the student
  double compile_seconds = 0, judge_seconds = 0;
  std::size_t compile_peak_bytes = 0, judge_peak_bytes = 0;

  /// The sum; none when it is not known because the grader failed.
  std::optional<double> points() const;
  int max() const { return result.possible(); }
};

/// "judged", or the name of the reason why not.
std::string state_of(const LabGrade& lab);

/// The marks of one exercise; none when the grader failed.
std::optional<double> points_of(const ExerciseResult& exercise);

/// For the student: what keeps an exercise of this lab from all its points, without colours.
std::string text_of(const LabGrade& lab, const ExerciseResult& exercise);

/// Everything about the grading of one submission.
struct Record {
  std::string name;
  std::string key;  ///< what the marks follow from: as long as it is the same, so are they
  std::vector<std::string> ignored;
  std::vector<LabGrade> labs;
  std::string source = {};  ///< where it was found; not kept in record.json

  std::optional<double> points() const;
  int max() const;
  bool complete() const { return points().has_value(); }
  /// "graded", or in words what was not: "lab 2 not submitted; lab 3 does not compile".
  std::string status() const;
};

/// A lab that was not judged, and why: no points, and no marks at all where the grader failed.
LabGrade unjudged(const Lab& lab, Status why, const std::string& note);

/// A judged lab, from the judge's verdicts. Throws Error when they are not of this lab.
LabGrade judged(const Lab& lab, const LabResult& result);

std::string to_json(const Record& record);
/// Throws Error when the text is no record.
Record record_from_json(const std::string& text);

/// The record in a submission's output folder; none when there is none, or a spoilt one.
std::optional<Record> load_record(const std::filesystem::path& folder);

}  // namespace carlo::grader
