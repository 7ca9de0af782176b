#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace carlo::grader {

/// Whether the files below `folder`, and those that the descendants of a process hold open though
/// they have no name any more, take more than `most` bytes, or are too many or lie too deep to be
/// counted. What cannot be looked into counts as nothing; nor does a nameless file that is mapped
/// and not open.
bool fuller_than(const std::filesystem::path& folder, pid_t ancestor, std::size_t most);

/// The resident memory of all descendants of a process together, in bytes. Pages that they share
/// count for each of them.
std::size_t descendants_bytes(pid_t ancestor);

}  // namespace carlo::grader
