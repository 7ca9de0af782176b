#include "grader/judge/results.h"

#include "support/error.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace carlo::grader {
namespace {

double points_of(const ExerciseResult& result) {
  if (!result.passed(Aspect::correctness)) return 0;
  int judged = 0, reached = 0;
  for (const Aspect aspect : {Aspect::variance, Aspect::efficiency}) {
    judged += result.has(aspect) ? 1 : 0;
    reached += result.passed(aspect) ? 1 : 0;
  }
  const double points = result.max;
  return judged == 0 ? points : points / 2 + points / 2 * reached / judged;
}

std::vector<std::string> missing_functions(const Exercise& exercise,
                                           const std::vector<TestRecord>& tests) {
  // "Moments::merge" in lab.json, "merge" in the worker's message: one of our names or none.
  const auto is_missing = [&](const std::string& function) {
    const std::size_t colon = function.rfind(':');
    const std::string name = colon == std::string::npos ? function : function.substr(colon + 1);
    return std::any_of(tests.begin(), tests.end(), [&](const TestRecord& test) {
      return !test.skipped && test.needs.empty() && test.missing == name;
    });
  };
  std::vector<std::string> list;
  std::copy_if(exercise.functions.begin(), exercise.functions.end(), std::back_inserter(list),
               is_missing);
  return list;
}

bool is_begun(const ExerciseResult& result, const Exercise& exercise) {
  if (result.status != Status::not_implemented) return false;
  const bool found_values =
      std::any_of(result.tests.begin(), result.tests.end(), [](const TestRecord& test) {
        return !test.skipped && test.status != Status::not_implemented;
      });
  // If nothing is written, every test meets the first function.
  const std::vector<std::string>& missing = result.missing;
  const bool beyond_the_first =
      !missing.empty() &&
      std::find(missing.begin(), missing.end(), exercise.functions.front()) == missing.end();
  return found_values || beyond_the_first;
}

/// Returns the exercises judged here that this one builds on and that are not right.
std::vector<std::string> unsound_ground(const Exercise& exercise, const LabResult& lab) {
  std::vector<std::string> tags;
  for (const ExerciseResult& other : lab.exercises) {
    const bool used =
        std::find(exercise.uses.begin(), exercise.uses.end(), other.tag) != exercise.uses.end();
    if (used && other.status != Status::passed) tags.push_back(other.tag);
  }
  return tags;
}

}  // namespace

ExerciseResult result_of(const Exercise& exercise, const std::vector<TestRecord>& tests) {
  ExerciseResult result;
  result.tag = exercise.tag;
  result.title = exercise.title;
  result.max = exercise.points;
  result.tests = tests;
  if (!result.has(Aspect::correctness)) {
    throw Error("no test has judged whether {} is right", exercise.tag);
  }
  result.status = Status::passed;
  for (const TestRecord& test : tests)
    result.status = std::max(result.status, test.status);
  result.points = points_of(result);
  result.diagnoses = diagnoses(tests);
  result.missing = missing_functions(exercise, tests);
  result.begun = is_begun(result, exercise);
  return result;
}

LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only) {
  std::map<std::string, std::vector<TestRecord>> tests;
  for (const TestRecord& record : records) {
    if (lab.find(record.tag) == nullptr || (!only.empty() && record.tag != only)) {
      throw Error("the test \"{}: {}\" belongs to no exercise judged here", record.tag,
                  record.sentence);
    }
    tests[record.tag].push_back(record);
  }
  LabResult result;
  result.lab = lab.number;
  result.title = lab.title;
  for (const Exercise& exercise : lab.exercises) {
    if (!only.empty() && exercise.tag != only) continue;
    result.exercises.push_back(result_of(exercise, tests[exercise.tag]));
  }
  if (result.exercises.empty()) throw Error("no exercise was judged");
  result.whole = result.exercises.size() == lab.exercises.size();
  for (ExerciseResult& entry : result.exercises)
    entry.unsound = unsound_ground(*lab.find(entry.tag), result);
  return result;
}

}  // namespace carlo::grader
