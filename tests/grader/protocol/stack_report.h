#pragma once

#include <string_view>

namespace carlo::grader {

/// What a worker says on stderr when its stack is full: these two, and between them the stack's
/// size in MB.
constexpr std::string_view stack_report = "the stack is full: ", stack_report_end = " MB";

}  // namespace carlo::grader
