#pragma once

// How a student learns in which line a program crashed, where no report has named it.

#include <fmt/core.h>

#include <string>

namespace carlo::grader {

/// What a crash says that the compiler has warned of, line and all.
constexpr const char* without_return = "a function came to its end without a return";

/// Whether a test's problem is a crash whose line is not known.
inline bool lacks_line(const std::string& problem) {
  const auto has = [&](const char* text) { return problem.find(text) != std::string::npos; };
  return problem.rfind("it crashed: ", 0) == 0 && !has(", in labs/") && !has(without_return);
}

/// What line_command() tells.
constexpr const char* which_line = "In which line it crashes (it builds for minutes, once)";

/// What to type; `exercise` is a number such as "1.2".
inline std::string line_command(const std::string& exercise) {
  return fmt::format("CARLO_PRESET=debug ./carlo test {}", exercise);
}

}  // namespace carlo::grader
