#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// Returns as few diagnoses as explain the failed comparisons of an exercise: the one that fits the
/// most, minus those that looked for it in vain, and others indistinguishable from it; then those
/// that explain the rest and were never looked for in vain. A value that fits some mistake by
/// chance, in one case of many, names nothing.
std::vector<Diagnosis> diagnoses(const std::vector<TestRecord>& tests);

/// Returns the result of an exercise's test cases. Its status is the gravest of theirs. It earns
/// nothing unless all tests of correctness passed; one whose variance or efficiency is judged too
/// earns half its points for being right, and the other half, split evenly, for each of these
/// aspects whose tests all passed. It is begun if some test got values, right or wrong, or its
/// first function is written. Throws Error if no test has judged whether it is right.
ExerciseResult result_of(const Exercise& exercise, const std::vector<TestRecord>& tests);

/// Groups the test records by exercise; `only` (a tag) selects one exercise unless it is empty.
/// Throws Error if an exercise has no test case, or a test case no exercise.
LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only);

}  // namespace carlo::grader
