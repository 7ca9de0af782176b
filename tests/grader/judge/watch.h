#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace carlo::grader {

/// Whether the files below `folder` take more than `most` bytes of the disk, or are too many or lie
/// too deep to be counted. What cannot be looked into counts as nothing.
bool fuller_than(const std::filesystem::path& folder, std::size_t most);

/// The resident memory of all descendants of a process together, in bytes. Pages that they share
/// count for each of them.
std::size_t descendants_bytes(pid_t ancestor);

}  // namespace carlo::grader
