#pragma once

#include "course/verdict/verdict.h"

#include <fmt/core.h>

#include <string>

namespace carlo {

/// How a text points to an exercise's hint: by the command to type, or by the key in watch.
enum class Help { typed, by_key };

/// Returns the report for the student, in colour where stdout shows it. `verbose`: every test and
/// every comparison, passed ones too.
std::string report_text(const LabResult& result, bool verbose = false);

/// Says, for the student, what keeps one exercise from all its points; empty if it passed. In
/// colour as above.
std::string shortfall(const ExerciseResult& result, Help help = Help::typed);

/// Says, in one sentence, what the second judgement found; there must be one.
std::string by_itself_text(const ExerciseResult& result);

/// Says what went wrong in one line; empty if it passed.
std::string message(const ExerciseResult& result);

/// What line_command() shows: how a student learns in which line a program crashed, if no report
/// has named it.
constexpr const char* which_line = "To find the line of the crash (the first build takes minutes)";

/// Returns the command to type; `exercise` is a number such as "1.2".
inline std::string line_command(const std::string& exercise) {
  return fmt::format("CARLO_PRESET=debug ./carlo test {}", exercise);
}

}  // namespace carlo
