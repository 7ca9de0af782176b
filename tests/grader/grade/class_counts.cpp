#include "grader/grade/class_counts.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace carlo::grader {
namespace {

/// Returns the kind of a crash, in the judge's words: "segmentation fault". What a program itself
/// said stands behind a colon or in parentheses.
std::string kind_of_crash(const ExerciseResult& exercise) {
  constexpr std::string_view crashed = "it crashed: ";
  if (exercise.by_itself) return "";
  for (const TestRecord& test : exercise.tests) {
    if (test.status != Status::crashed || test.skipped) continue;
    std::string cause = test.problem;
    if (cause.starts_with(crashed)) cause.erase(0, crashed.size());
    cause.resize(std::min(cause.find_first_of("(:,"), cause.size()));
    cause.erase(cause.find_last_not_of(' ') + 1);
    return cause;
  }
  return "";
}

/// Counts what kept a student from the points: the likeliest mistake, if the judge names one, and
/// whether the program was ended.
void count_mistakes(const ExerciseResult& exercise, std::map<std::string, Mistake>& mistakes) {
  const auto add = [&](const std::string& id, const std::string& sentence) {
    Mistake& mistake = mistakes[id];
    mistake.sentence = sentence;
    ++mistake.students;
  };
  const Status status = exercise.by_itself ? exercise.by_itself->status : exercise.status;
  if (!exercise.causes().empty())
    add(exercise.causes().front().id, exercise.causes().front().sentence);
  if (status == Status::crashed) {
    const std::string kind = kind_of_crash(exercise);
    add("~crash " + kind, "the program crashes" + (kind.empty() ? "." : ": " + kind + "."));
  } else if (status == Status::timeout) {
    add("~timeout",
        "the program is not done in time: a loop that does not end, or far too much work.");
  }
}

}  // namespace

Standing standing_of(const ExerciseResult& exercise) {
  if (exercise.status == Status::grader_error) return Standing::not_judged;
  if (exercise.right_by_itself()) return Standing::by_itself;
  if (exercise.points >= exercise.max) return Standing::right;
  if (exercise.status == Status::does_not_compile) return Standing::not_compiled;
  if (exercise.status >= Status::not_implemented) return Standing::not_done;
  if (!exercise.unsound.empty() && !exercise.by_itself) return Standing::follows;
  return exercise.points > 0 ? Standing::partly : Standing::wrong;
}

std::size_t ClassColumn::count(Standing standing) const {
  const auto found = standings.find(standing);
  return found == standings.end() ? 0 : found->second;
}

std::size_t ClassColumn::judged() const {
  std::size_t sum = 0;
  for (const auto& [standing, number] : standings)
    sum += standing == Standing::not_judged ? 0 : number;
  return sum;
}

double ClassColumn::right() const {
  const std::size_t students = count(Standing::right) + count(Standing::by_itself);
  return judged() == 0 ? 0 : static_cast<double>(students) / static_cast<double>(judged());
}

double ClassColumn::mean() const {
  return judged() == 0 ? 0 : points / static_cast<double>(judged());
}

std::vector<ClassColumn> class_columns(const std::vector<Record>& records) {
  std::vector<ClassColumn> columns;
  for (const LabGrade& lab : records.front().labs) {
    for (const ExerciseResult& exercise : lab.result.exercises)
      columns.push_back({&exercise});
  }
  for (const Record& record : records) {
    std::size_t at = 0;
    for (const LabGrade& lab : record.labs) {
      for (const ExerciseResult& exercise : lab.result.exercises) {
        ClassColumn& column = columns.at(at++);
        const Standing standing = standing_of(exercise);
        ++column.standings[standing];
        if (standing != Standing::not_judged) column.points += exercise.points;
        if (standing == Standing::right || standing == Standing::by_itself) continue;
        count_mistakes(exercise, column.mistakes);
      }
    }
  }
  return columns;
}

std::size_t count_unjudged(const std::vector<Record>& records, std::size_t lab, Status why) {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(),
                    [&](const Record& record) { return record.labs.at(lab).unjudged == why; }));
}

}  // namespace carlo::grader
