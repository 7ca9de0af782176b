#pragma once

#include "grader/judge/asked.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// How a worker that was run by hand ended.
struct Rerun {
  bool values = false;  ///< a table came back
  bool crashed = false;
  std::string how;    ///< "segmentation fault"; empty unless it crashed
  std::string place;  ///< "labs/01_integration/integration.cpp:17", when the program told
};

/// The command that puts the question to a worker: the first `rows` rows of its table as text, all
/// for 0.
std::vector<std::string> command(const std::string& worker, const Asked& asked, std::size_t rows);

/// Runs it here, without sandbox and limits. What it prints is passed on as it comes; in what it
/// says on stderr the place of a crash is looked for, as the sanitizers tell it: the first line of
/// a file below labs/. Throws Error when it cannot be run.
Rerun rerun(const std::vector<std::string>& command);

/// Becomes the debugger with this command in it; throws Error when that cannot be run.
[[noreturn]] void debug(const std::string& debugger, const std::vector<std::string>& command);

}  // namespace carlo::grader
