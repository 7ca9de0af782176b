#pragma once

#include <string>

namespace carlo::grader {

/// What a machine is like to grade on: in words, and whether a class may be graded there at all.
struct Machine {
  std::string text;
  bool good = false;
};

/// Tries every level of the sandbox, what protects submissions from one another, and how many of
/// them the machine bears at a time. For this process alone, which should end soon after: trying
/// leaves mounts that nobody else sees.
Machine check_machine();

}  // namespace carlo::grader
