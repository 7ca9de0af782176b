#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace carlo::grader {

/// Whether the files below `folder` take more than `most` bytes of the disk, or are too many to be
/// counted. What cannot be looked into counts as nothing.
bool fuller_than(const std::filesystem::path& folder, std::size_t most);

/// The memory of a process's descendants that they do not share with files or others, in bytes; 0
/// where the kernel does not list children.
std::size_t descendants_bytes(pid_t ancestor);

}  // namespace carlo::grader
