#pragma once

#include "grader/grade/clean_tree.h"
#include "grader/grade/intake.h"
#include "grader/grade/record.h"
#include "grader/judge/sandbox.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// The settings of grading, the same for all submissions.
struct Course {
  std::filesystem::path tree, build;  ///< the repository and its build folder
  std::vector<CourseLab> labs;
  const CleanTree& clean;
  Sandbox sandbox;
  std::string secret;
  double deadline = 10;   ///< seconds per probe
  std::string toolchain;  ///< the toolchain here: toolchain_of()
  std::string digest;     ///< of the grader and the secret
};

/// Grades one submission: compiles and judges lab after lab. `name` is its name, `folder` is for
/// temporary files. A lab that cannot be judged through no fault of the student is retried once,
/// then has no marks.
Record grade(const Course& course, const std::string& name, const Intake& intake,
             const std::filesystem::path& folder);

/// Returns a digest of what the marks of a submission depend on.
std::string record_key(const Course& course, const std::string& name, const Intake& intake);

/// Returns a digest of the judges, the clean tree, the labs, the secret, the compiler and this
/// program.
std::string course_digest(const Course& course);

/// Returns a record without marks: the grader failed.
Record failed_record(const Course& course, const std::string& name, const std::string& why);

}  // namespace carlo::grader
