#pragma once

#include "grader/judge/asked.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// The outcome of a worker that was run by hand.
struct Rerun {
  bool values = false;  ///< a table came back
  bool crashed = false;
  std::string how;    ///< "segmentation fault"; empty unless it crashed
  std::string place;  ///< "labs/01_integration/integration.cpp:17", if the program reported it
};

/// Returns the command that asks a worker the question: the first `rows` rows of its table as text,
/// all for 0.
std::vector<std::string> command(const std::string& worker, const Asked& asked, std::size_t rows);

/// Runs it here, without sandbox and limits. Passes on its output as it comes, and finds the place
/// of a crash in its stderr as sanitizers report it: the first line of a file below labs/. Throws
/// Error if it cannot be run.
Rerun rerun(const std::vector<std::string>& command);

/// Becomes the debugger with this command in it; throws Error if that cannot be run.
[[noreturn]] void debug(const std::string& debugger, const std::vector<std::string>& command);

}  // namespace carlo::grader
