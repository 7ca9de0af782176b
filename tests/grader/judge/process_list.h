#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace carlo::grader {

/// A process as the system lists it.
struct ProcessEntry {
  pid_t id = 0, parent = 0;
  char state = '?';  ///< of its first thread: R, S, D, ... (proc(5))
  std::size_t resident_bytes = 0;
  double seconds = 0;  ///< processor time, including children that it has waited for
  std::size_t threads = 0;
};

/// Lists all current processes, from /proc; those that end meanwhile may be missing.
std::vector<ProcessEntry> list_processes();

/// Returns the descendants of one process among these.
std::vector<ProcessEntry> descendants_of(pid_t ancestor);

/// A thread's times in seconds (Linux, proc(5): schedstat). 0 if the system does not provide them.
struct ThreadTimes {
  double ran = 0;     ///< on a processor
  double waited = 0;  ///< ready to run while others had them; a wait counts once it has ended

  bool operator==(const ThreadTimes&) const = default;
};

/// A thread as the system lists it.
struct ThreadEntry {
  pid_t id = 0;
  bool ready = false;  ///< runs, or waits only for a processor
  ThreadTimes times;
};

/// Lists the current threads of a process.
std::vector<ThreadEntry> list_threads(const ProcessEntry& process);

/// Returns the times of the calling thread.
ThreadTimes own_times();

/// Returns the size of a process's page tables, which no limit and no resident size counts: 0 if it
/// is gone.
std::size_t page_table_bytes(pid_t id);

/// Returns whether a process has this user id as its real, effective or saved one.
bool has_process_of(uid_t user);

}  // namespace carlo::grader
