#pragma once

#include "grader/judge/run.h"

#include <memory>

namespace carlo::grader {

/// The run that test cases report to: Catch2 calls them without arguments, so it must be reachable
/// from anywhere. main() creates it before the first test case starts.
std::unique_ptr<Run>& current_run();

}  // namespace carlo::grader
