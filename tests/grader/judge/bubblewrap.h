#pragma once

#include "course/cli/descriptor.h"
#include "grader/judge/sandbox.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

inline constexpr const char* bubblewrap_program = "/usr/bin/bwrap";

/// Returns the paths of the system's programs and libraries, and of what locates them; not all
/// exist everywhere.
const std::vector<std::filesystem::path>& system_paths();

/// Returns the command line that runs `argv` in its own namespaces. bubblewrap reads the system
/// call filter from descriptor 4, and writes the exit code to 5 if the program was started.
std::vector<std::string> bubblewrap(const std::vector<std::string>& argv, const View& view,
                                    const std::filesystem::path& scratch);

/// Returns a filter in bubblewrap's format. Throws Error.
Descriptor filter_file(const SyscallFilter& filter);

}  // namespace carlo::grader
