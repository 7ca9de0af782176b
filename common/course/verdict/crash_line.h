#pragma once

// How a student learns in which line a program crashed, if no report has named it.

#include <fmt/core.h>

#include <string>

namespace carlo {

/// What line_command() shows.
constexpr const char* which_line = "To find the line of the crash (the first build takes minutes)";

/// Returns the command to type; `exercise` is a number such as "1.2".
inline std::string line_command(const std::string& exercise) {
  return fmt::format("CARLO_PRESET=debug ./carlo test {}", exercise);
}

}  // namespace carlo
