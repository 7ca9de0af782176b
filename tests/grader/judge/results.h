#pragma once

#include "course/exercises.h"
#include "grader/judge/verdict.h"

#include <cstdint>
#include <string>
#include <vector>

namespace carlo::grader {

/// Why a test or an exercise has not passed; the gravest last, so that the largest is shown.
enum class Status { passed, failed, crashed, timeout, not_implemented };
std::string to_string(Status status);

/// One test case: its verdicts, or what kept the values from coming.
struct TestRecord {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< what follows the tag in its name
  std::vector<Verdict> verdicts;
  Status status = Status::failed;  ///< passed only after a verdict, and when all passed
  std::string problem;             ///< why there are no values; empty when there are
  std::string printed;             ///< what the student's program printed, when there was a problem
  bool skipped = false;            ///< not run, because an earlier test told what would come
  std::string needs = {};          ///< the tag of another exercise, when that is the one not done
};

/// One exercise after all its test cases.
struct ExerciseResult {
  Exercise exercise;
  Status status = Status::failed;
  std::vector<TestRecord> tests;

  int earned() const { return status == Status::passed ? exercise.points : 0; }
};

struct LabResult {
  Lab lab;
  std::vector<ExerciseResult> exercises;
  std::uint64_t seed = 0;
  std::string sandbox;

  int earned() const;
  int possible() const;
};

/// Sorts the test records by exercise; `only` (a tag) leaves out the other exercises unless it is
/// empty. Throws Error when an exercise has no test case, or a test case no exercise.
LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only);

}  // namespace carlo::grader
