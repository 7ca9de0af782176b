#pragma once

#include "course/exercises.h"
#include "grader/judge/verdict.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carlo::grader {

/// Why a test or an exercise has not passed; the gravest last, so that the largest is shown.
enum class Status { passed, failed, crashed, timeout, not_implemented };
std::string to_string(Status status);

/// What a test case judges: whether the values are right; or, of right values, how much they
/// scatter or what they cost.
enum class Aspect { correctness, variance, efficiency };
std::string to_string(Aspect aspect);

/// The aspect that a test case's tags name: [variance], [efficiency], else correctness. Throws
/// Error when they name both.
Aspect aspect_of(const std::vector<std::string>& tags);

/// One test case: its verdicts, or what kept the values from coming.
struct TestRecord {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< what follows the tag in its name
  std::vector<Verdict> verdicts;
  Status status = Status::failed;  ///< passed only after a verdict, and when all passed
  std::string problem;             ///< why there are no values; empty when there are
  std::string printed;       ///< the start of what the program printed, when there was a problem
  bool skipped = false;      ///< not run, or not judged: another test told what would come
  std::string needs = {};    ///< the tag of another exercise, when that is the one not done
  std::string missing = {};  ///< the function that is not done, as the worker calls it
  Aspect aspect = Aspect::correctness;
  std::size_t lost_lines = 0;  ///< that the program printed beyond `printed`
};

/// One exercise after all its test cases.
struct ExerciseResult {
  Exercise exercise;
  Status status = Status::failed;
  std::vector<TestRecord> tests;

  /// Whether there are tests of this aspect, and whether all of them passed.
  bool has(Aspect aspect) const;
  bool passed(Aspect aspect) const;
  /// Nothing unless all tests of correctness passed. An exercise whose variance or efficiency is
  /// judged too earns half its points for being right, and the other half, split evenly, for each
  /// of these aspects whose tests all passed.
  double earned() const;
};

struct LabResult {
  Lab lab;
  std::vector<ExerciseResult> exercises;
  std::uint64_t seed = 0;
  std::string sandbox;

  double earned() const;
  int possible() const;
};

/// The functions of an exercise that its tests came upon and found not done, as lab.json lists
/// them.
std::vector<std::string> missing_functions(const ExerciseResult& result);

/// Whether an exercise that is not done is begun: some test found values, right or wrong, or its
/// first function is written.
bool begun(const ExerciseResult& result);

/// What an exercise's failed comparisons look like, in as few diagnoses as explain them: the one
/// that fits most of them, less those that looked for it in vain, and others that nothing tells
/// from it; then such as explain what is left and were never looked for in vain. A value that fits
/// some mistake by chance, in one case of many, names nothing.
std::vector<Diagnosis> diagnoses(const ExerciseResult& result);

/// Points for people: "2", "1.5", "0.75".
std::string points_text(double points);

/// Sorts the test records by exercise; `only` (a tag) leaves out the other exercises unless it is
/// empty. Throws Error when an exercise has no test case, or a test case no exercise.
LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only);

}  // namespace carlo::grader
