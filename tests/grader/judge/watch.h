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

/// Seconds of threads that are there now (Linux, proc(5): schedstat). 0 where the system does not
/// tell.
struct ThreadTimes {
  double ran = 0;     ///< on a processor, of the one that ran longest
  double waited = 0;  ///< ready to run while others had them, of the one that waited longest

  bool operator==(const ThreadTimes&) const = default;
};
ThreadTimes longest_times(const Family& family);

/// Whether one of them runs, or waits for nothing but a processor.
bool runnable(const Family& family);

/// Whether none of them runs or could, and one waits for a disk, or for memory that others have.
bool blocked(const Family& family);

/// Those of the thread that calls.
ThreadTimes own_times();

/// Their processor seconds and those of children that they have waited for.
double processor_seconds(const Family& family);

}  // namespace carlo::grader
