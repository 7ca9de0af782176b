#pragma once

#include <string>

namespace carlo::grader {

/// A machine's suitability for grading: a description, and whether a class may be graded there at
/// all.
struct Machine {
  std::string text;
  bool good = false;
};

/// Tries every level of the sandbox, the protection of submissions from one another, and how many
/// at a time the machine can handle. Call it in a process that ends soon after: trying leaves
/// mounts that nobody else sees.
Machine check_machine();

}  // namespace carlo::grader
