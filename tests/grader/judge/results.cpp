#include "grader/judge/results.h"

#include "cli/error.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace carlo::grader {

std::string to_string(Status status) {
  switch (status) {
    case Status::passed:
      return "passed";
    case Status::failed:
      return "failed";
    case Status::crashed:
      return "crashed";
    case Status::timeout:
      return "timeout";
    case Status::not_implemented:
      return "not_implemented";
  }
  throw Error("unknown status");
}

std::string to_string(Aspect aspect) {
  switch (aspect) {
    case Aspect::correctness:
      return "correctness";
    case Aspect::variance:
      return "variance";
    case Aspect::efficiency:
      return "efficiency";
  }
  throw Error("unknown aspect");
}

Aspect aspect_of(const std::vector<std::string>& tags) {
  const auto named = [&](Aspect aspect) {
    return std::find(tags.begin(), tags.end(), to_string(aspect)) != tags.end();
  };
  const bool variance = named(Aspect::variance), efficiency = named(Aspect::efficiency);
  if (variance && efficiency) throw Error("a test judges variance or efficiency, not both");
  return variance ? Aspect::variance : efficiency ? Aspect::efficiency : Aspect::correctness;
}

bool ExerciseResult::has(Aspect aspect) const {
  return std::any_of(tests.begin(), tests.end(),
                     [&](const TestRecord& test) { return test.aspect == aspect; });
}

bool ExerciseResult::passed(Aspect aspect) const {
  return has(aspect) && std::all_of(tests.begin(), tests.end(), [&](const TestRecord& test) {
           return test.aspect != aspect || test.status == Status::passed;
         });
}

double ExerciseResult::earned() const {
  if (!passed(Aspect::correctness)) return 0;
  int judged = 0, reached = 0;
  for (const Aspect aspect : {Aspect::variance, Aspect::efficiency}) {
    judged += has(aspect) ? 1 : 0;
    reached += passed(aspect) ? 1 : 0;
  }
  const double points = exercise.points;
  return judged == 0 ? points : points / 2 + points / 2 * reached / judged;
}

std::string points_text(double points) {
  return fmt::format("{:.10g}", points);
}

double LabResult::earned() const {
  return std::accumulate(exercises.begin(), exercises.end(), 0.0,
                         [](double sum, const ExerciseResult& e) { return sum + e.earned(); });
}

int LabResult::possible() const {
  return std::accumulate(exercises.begin(), exercises.end(), 0,
                         [](int sum, const ExerciseResult& e) { return sum + e.exercise.points; });
}

std::vector<std::string> missing_functions(const ExerciseResult& result) {
  // "Moments::merge" in lab.json, "merge" in what the worker says: a name of ours or none.
  const auto is_missing = [&](const std::string& function) {
    const std::size_t colon = function.rfind(':');
    const std::string name = colon == std::string::npos ? function : function.substr(colon + 1);
    return std::any_of(result.tests.begin(), result.tests.end(), [&](const TestRecord& test) {
      return !test.skipped && test.needs.empty() && test.missing == name;
    });
  };
  std::vector<std::string> list;
  std::copy_if(result.exercise.functions.begin(), result.exercise.functions.end(),
               std::back_inserter(list), is_missing);
  return list;
}

bool begun(const ExerciseResult& result) {
  if (result.status != Status::not_implemented) return false;
  const bool found_values =
      std::any_of(result.tests.begin(), result.tests.end(), [](const TestRecord& test) {
        return !test.skipped && test.status != Status::not_implemented;
      });
  // Where nothing is written, every test comes upon the first function.
  const std::vector<std::string> missing = missing_functions(result);
  const bool beyond_the_first =
      !missing.empty() &&
      std::find(missing.begin(), missing.end(), result.exercise.functions.front()) == missing.end();
  return found_values || beyond_the_first;
}

LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only) {
  LabResult result;
  result.lab = lab;
  for (const Exercise& exercise : lab.exercises) {
    if (!only.empty() && exercise.tag != only) continue;
    result.exercises.push_back({exercise, Status::passed, {}});
  }
  for (const TestRecord& record : records) {
    const auto found =
        std::find_if(result.exercises.begin(), result.exercises.end(),
                     [&](const ExerciseResult& entry) { return entry.exercise.tag == record.tag; });
    if (found == result.exercises.end()) {
      throw Error("the test \"{}: {}\" belongs to no exercise judged here", record.tag,
                  record.sentence);
    }
    found->status = std::max(found->status, record.status);
    found->tests.push_back(record);
  }
  for (const ExerciseResult& entry : result.exercises) {
    if (!entry.has(Aspect::correctness)) {
      throw Error("no test has judged whether {} is right", entry.exercise.tag);
    }
  }
  if (result.exercises.empty()) throw Error("no exercise was judged");
  return result;
}

}  // namespace carlo::grader
