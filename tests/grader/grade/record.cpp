#include "grader/grade/record.h"

#include "cli/error.h"

#include <fmt/core.h>

namespace carlo::grader {
namespace {

using nlohmann::json;

/// Points that the rules of results.h can give: quarters of whole numbers, from 0 to the most.
bool possible_points(double points, int max) {
  const double quarters = points * 4;
  return points >= 0 && points <= max &&
         quarters == static_cast<double>(static_cast<int>(quarters));
}

std::string in_words(LabState state) {
  switch (state) {
    case LabState::judged:
      return "judged";
    case LabState::not_submitted:
      return "not submitted";
    case LabState::refused:
      return "refused";
    case LabState::does_not_compile:
      return "does not compile";
    case LabState::grader_error:
      return "not graded: an error of the grader";
  }
  throw Error("unknown state");
}

}  // namespace

std::string to_string(LabState state) {
  return state == LabState::judged             ? "judged"
         : state == LabState::not_submitted    ? "not_submitted"
         : state == LabState::refused          ? "refused"
         : state == LabState::does_not_compile ? "does_not_compile"
                                               : "grader_error";
}

std::optional<double> LabGrade::points() const {
  double sum = 0;
  for (const ExerciseGrade& exercise : exercises) {
    if (!exercise.points) return {};
    sum += *exercise.points;
  }
  return sum;
}

int LabGrade::max() const {
  int sum = 0;
  for (const ExerciseGrade& exercise : exercises)
    sum += exercise.max;
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
  for (const LabGrade& lab : labs) {
    if (lab.state == LabState::judged) continue;
    text += fmt::format("{}lab {} {}", text.empty() ? "" : "; ", lab.number, in_words(lab.state));
  }
  return text.empty() ? "graded" : text;
}

LabGrade unjudged(const Lab& lab, LabState state, const std::string& note) {
  LabGrade grade;
  grade.number = lab.number;
  grade.title = lab.title;
  grade.state = state;
  grade.note = note;
  for (const Exercise& exercise : lab.exercises) {
    ExerciseGrade entry{exercise.tag, exercise.title, 0.0, exercise.points, to_string(state), note};
    if (state == LabState::grader_error) entry.points.reset();
    grade.exercises.push_back(entry);
  }
  return grade;
}

LabGrade judged(const Lab& lab, const json& verdict) {
  LabGrade grade = unjudged(lab, LabState::judged, "");
  try {
    const json& list = verdict.at("exercises");
    if (verdict.at("lab") != lab.number || list.size() != lab.exercises.size()) {
      throw Error("the judge's verdict is of another lab");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      ExerciseGrade& entry = grade.exercises[i];
      const auto points = list[i].at("points").get<double>();
      if (list[i].at("tag") != entry.tag || !possible_points(points, entry.max)) {
        throw Error("the judge's verdict of {} makes no sense", entry.tag);
      }
      entry.points = points;
      entry.status = list[i].at("status").get<std::string>();
      entry.text = list[i].at("text").get<std::string>();
    }
    grade.sandbox = verdict.at("sandbox").get<std::string>();
  } catch (const json::exception& error) {
    throw Error("the judge's verdict of lab {} is no verdict: {}", lab.number, error.what());
  }
  grade.verdict = verdict;
  return grade;
}

}  // namespace carlo::grader
