#pragma once

#include "course/cli/descriptor.h"
#include "grader/judge/sandbox.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

inline constexpr const char* bubblewrap_program = "/usr/bin/bwrap";

/// Where the system's programs and libraries are, and what finds them; not all exist everywhere.
const std::vector<std::filesystem::path>& system_paths();

/// The command line that runs `argv` with namespaces of its own. The filter of system calls comes
/// over descriptor 4; over 5 it tells its exit code, if the program was begun.
std::vector<std::string> bubblewrap(const std::vector<std::string>& argv, const View& view,
                                    const std::filesystem::path& scratch);

/// A filter as bubblewrap reads it. Throws Error.
Descriptor filter_file(const SyscallFilter& filter);

}  // namespace carlo::grader
