#pragma once

#include "grader/judge/process_list.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace carlo::grader {

/// Processes that are watched together, as listed.
using Family = std::vector<ProcessEntry>;

/// Returns whether the files below `folder`, and nameless ones that the family's processes hold
/// open, take more than `most` bytes, or are too many or too deep to be counted. Unreadable folders
/// count as nothing, and so does a nameless file that is mapped and not open.
bool fuller_than(const std::filesystem::path& folder, const Family& family, std::size_t most);

/// Returns the memory of all together, in bytes: resident pages and page tables. Shared pages count
/// for each process.
std::size_t memory_bytes(const Family& family);

/// Returns the number of their threads; at least one per process.
std::size_t threads_of(const Family& family);

/// Returns whether none of them runs or could run, and one waits for a disk, or for memory that
/// others have.
bool blocked(const Family& family);

/// Returns their processor seconds and those of children that they have waited for.
double processor_seconds(const Family& family);

}  // namespace carlo::grader
