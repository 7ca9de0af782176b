#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// What the failed comparisons of an exercise look like, in as few diagnoses as explain them: the
/// one that fits most of them, less those that looked for it in vain, and others that nothing tells
/// from it; then such as explain what is left and were never looked for in vain. A value that fits
/// some mistake by chance, in one case of many, names nothing.
std::vector<Diagnosis> diagnoses(const std::vector<TestRecord>& tests);

/// What follows from an exercise's test cases. Its status is that of the gravest. It earns nothing
/// unless all tests of correctness passed; one whose variance or efficiency is judged too earns
/// half its points for being right, and the other half, split evenly, for each of these aspects
/// whose tests all passed. It is begun when some test found values, right or wrong, or its first
/// function is written. Throws Error when no test has judged whether it is right.
ExerciseResult result_of(const Exercise& exercise, const std::vector<TestRecord>& tests);

/// Sorts the test records by exercise; `only` (a tag) leaves out the other exercises unless it is
/// empty. Throws Error when an exercise has no test case, or a test case no exercise.
LabResult collect(const Lab& lab, const std::vector<TestRecord>& records, const std::string& only);

}  // namespace carlo::grader
