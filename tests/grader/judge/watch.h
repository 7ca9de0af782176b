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

/// For how many seconds, of all threads of `ancestor`'s descendants that are there now, the one
/// that waited longest was ready to run while others had the processors (Linux, proc(5):
/// schedstat). 0 where the system does not tell.
double longest_wait(pid_t ancestor);

/// Processor seconds of `ancestor`'s descendants that are there now and of those they have waited
/// for.
double descendants_seconds(pid_t ancestor);

}  // namespace carlo::grader
