#pragma once

// How a student learns in which line a program crashed, where no report has named it.

#include <fmt/core.h>

#include <string>

namespace carlo::grader {

/// Whether a test's problem is a crash whose line is not known.
inline bool lacks_line(const std::string& problem) {
  return problem.rfind("it crashed: ", 0) == 0 && problem.find(", in labs/") == std::string::npos;
}

/// What line_command() tells.
constexpr const char* which_line = "In which line it crashes (it builds for minutes, once)";

/// What to type; `exercise` is a number such as "1.2".
inline std::string line_command(const std::string& exercise) {
  return fmt::format("CARLO_PRESET=debug ./carlo test {}", exercise);
}

}  // namespace carlo::grader
