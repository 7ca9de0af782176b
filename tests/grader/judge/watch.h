#pragma once

#include "grader/judge/process_list.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace carlo::grader {

/// Processes that are watched together, as they were listed.
using Family = std::vector<ProcessEntry>;

/// Whether the files below `folder`, and those that the family's processes hold open though they
/// have no name any more, take more than `most` bytes, or are too many or lie too deep to be
/// counted. What cannot be looked into counts as nothing; nor does a nameless file that is mapped
/// and not open.
bool fuller_than(const std::filesystem::path& folder, const Family& family, std::size_t most);

/// The memory of all together, in bytes: what is resident, and its page tables. Pages that they
/// share count for each of them.
std::size_t memory_bytes(const Family& family);

/// Their threads; a process has one at least.
std::size_t threads_of(const Family& family);

/// Whether none of them runs or could, and one waits for a disk, or for memory that others have.
bool blocked(const Family& family);

/// Their processor seconds and those of children that they have waited for.
double processor_seconds(const Family& family);

}  // namespace carlo::grader
