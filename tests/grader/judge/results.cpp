#include "grader/judge/results.h"

#include "cli/error.h"

#include <algorithm>
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

int LabResult::earned() const {
  return std::accumulate(exercises.begin(), exercises.end(), 0,
                         [](int sum, const ExerciseResult& e) { return sum + e.earned(); });
}

int LabResult::possible() const {
  return std::accumulate(exercises.begin(), exercises.end(), 0,
                         [](int sum, const ExerciseResult& e) { return sum + e.exercise.points; });
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
    if (entry.tests.empty()) throw Error("no test has judged {}", entry.exercise.tag);
  }
  if (result.exercises.empty()) throw Error("no exercise was judged");
  return result;
}

}  // namespace carlo::grader
