#include "grader/grade/record.h"

#include "course/cli/wrap.h"
#include "course/verdict/verdict_text.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo::grader {
namespace {

/// Returns whether the rules of results.h can give these points: quarters of whole numbers, from 0
/// to `max`.
bool possible_points(double points, int max) {
  const double quarters = points * 4;
  return points >= 0 && points <= max &&
         quarters == static_cast<double>(static_cast<int>(quarters));
}

/// The longest text for a student: a program can make messages about it long.
constexpr std::size_t most_text = 20'000;

}  // namespace

std::string in_words(Status unjudged) {
  if (unjudged == Status::grader_error) return "not graded: an error of the grader";
  std::string words = to_string(unjudged);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string state_of(const LabGrade& lab) {
  return lab.unjudged ? to_string(*lab.unjudged) : "judged";
}

std::optional<double> points_of(const ExerciseResult& exercise) {
  if (exercise.status == Status::grader_error) return {};
  return exercise.points;
}

std::string text_of(const LabGrade& lab, const ExerciseResult& exercise) {
  if (lab.unjudged) return lab.note;
  std::string text = without_escapes(shortfall(exercise));
  if (text.size() > most_text) text = text.substr(0, most_text) + " ...\n";
  return text;
}

std::optional<double> LabGrade::points() const {
  double sum = 0;
  for (const ExerciseResult& exercise : result.exercises) {
    const std::optional<double> points = points_of(exercise);
    if (!points) return {};
    sum += *points;
  }
  return sum;
}

std::optional<double> Record::points() const {
  double sum = 0;
  for (const LabGrade& lab : labs) {
    const std::optional<double> points = lab.points();
    if (!points) return {};
    sum += *points;
  }
  return sum;
}

int Record::max() const {
  int sum = 0;
  for (const LabGrade& lab : labs)
    sum += lab.max();
  return sum;
}

std::string Record::status() const {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
  for (const LabGrade& lab : labs) {
    if (lab.unjudged) add(fmt::format("lab {} {}", lab.result.lab, in_words(*lab.unjudged)));
    for (const ExerciseResult& exercise : lab.result.exercises)
      if (exercise.right_by_itself()) add(exercise.number() + " right by itself");
  }
  return text.empty() ? "graded" : text;
}

LabGrade unjudged(const Lab& lab, Status why, const std::string& note) {
  LabGrade grade;
  grade.result.lab = lab.number;
  grade.result.title = lab.title;
  grade.unjudged = why;
  grade.note = note;
  for (const Exercise& exercise : lab.exercises) {
    ExerciseResult result;
    result.tag = exercise.tag;
    result.title = exercise.title;
    result.max = exercise.points;
    result.status = why;
    grade.result.exercises.push_back(result);
  }
  return grade;
}

void check_result(const Exercise& exercise, const ExerciseResult& result) {
  if (result.tag != exercise.tag || result.max != exercise.points ||
      !possible_points(result.points, exercise.points)) {
    throw Error("the judge's verdict of {} makes no sense", exercise.tag);
  }
}

LabGrade judged(const Lab& lab, const LabResult& result) {
  const std::vector<ExerciseResult>& list = result.exercises;
  if (result.lab != lab.number || list.size() != lab.exercises.size()) {
    throw Error("the judge's verdict is of another lab");
  }
  for (std::size_t i = 0; i < list.size(); ++i)
    check_result(lab.exercises[i], list[i]);
  LabGrade grade;
  grade.result = result;
  return grade;
}

}  // namespace carlo::grader
