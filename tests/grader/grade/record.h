#pragma once

#include "course/exercises.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// What became of one lab of a submission. `grader_error` is our fault: it has no marks, not 0.
enum class LabState { judged, not_submitted, refused, does_not_compile, grader_error };
std::string to_string(LabState state);

/// The marks of one exercise.
struct ExerciseGrade {
  std::string tag, title;
  std::optional<double> points;  ///< none: it could not be judged
  int max = 0;
  std::string status;  ///< the judge's, or the lab's state
  std::string text;    ///< for the student: what failed and how; empty when it passed
};

struct LabGrade {
  int number = 0;
  std::string title;
  LabState state = LabState::grader_error;
  std::string note;                  ///< for the student: why it was not judged, or files left out
  std::string compiler;              ///< the compiler's messages, warnings too
  std::string report;                ///< the judge's, for the student
  nlohmann::json verdict = nullptr;  ///< the judge's JSON, when it came to one
  std::vector<ExerciseGrade> exercises;
  std::string sandbox;
  double compile_seconds = 0, judge_seconds = 0;
  std::size_t compile_peak_bytes = 0, judge_peak_bytes = 0;

  /// The sum; none when an exercise has no marks.
  std::optional<double> points() const;
  int max() const;
};

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

/// A lab that was not judged: every exercise with `points` and the state as its status.
LabGrade unjudged(const Lab& lab, LabState state, const std::string& note);

/// A judged lab, from the judge's verdict. Throws Error when that is not one of this lab.
LabGrade judged(const Lab& lab, const nlohmann::json& verdict);

std::string to_json(const Record& record);
/// Throws Error when the text is no record.
Record record_from_json(const std::string& text);

/// The record in a submission's output folder; none when there is none, or a spoilt one.
std::optional<Record> load_record(const std::filesystem::path& folder);

}  // namespace carlo::grader
