#include "course/verdict/verdict.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace carlo {

bool ExerciseResult::has(Aspect aspect) const {
  return std::any_of(tests.begin(), tests.end(),
                     [&](const TestRecord& test) { return test.aspect == aspect; });
}

bool ExerciseResult::passed(Aspect aspect) const {
  return has(aspect) && std::all_of(tests.begin(), tests.end(), [&](const TestRecord& test) {
           return test.aspect != aspect || test.status == Status::passed;
         });
}

bool ExerciseResult::right_by_itself() const {
  return status != Status::passed && by_itself && by_itself->status == Status::passed;
}

const std::vector<Diagnosis>& ExerciseResult::causes() const {
  return by_itself ? by_itself->diagnoses : diagnoses;
}

double LabResult::earned() const {
  return std::accumulate(
      exercises.begin(), exercises.end(), 0.0,
      [](double sum, const ExerciseResult& exercise) { return sum + exercise.points; });
}

int LabResult::possible() const {
  return std::accumulate(
      exercises.begin(), exercises.end(), 0,
      [](int sum, const ExerciseResult& exercise) { return sum + exercise.max; });
}

std::string points_text(double points) {
  return fmt::format("{:.10g}", points);
}

}  // namespace carlo
