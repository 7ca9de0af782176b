#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace carlo::grader {

/// A process as the system lists it.
struct ProcessEntry {
  pid_t id = 0, parent = 0;
  char state = '?';  ///< R, S, D, ... (proc(5)), of its first thread
  std::size_t resident_bytes = 0;
  double seconds = 0;  ///< of processor time, and of the children that it has waited for
  std::size_t threads = 0;
};

/// All processes that are there now, as /proc tells; those that end meanwhile may be missing.
std::vector<ProcessEntry> list_processes();

/// Of these the descendants of one.
std::vector<ProcessEntry> descendants_of(pid_t ancestor);

/// Seconds of a thread (Linux, proc(5): schedstat). 0 where the system does not tell.
struct ThreadTimes {
  double ran = 0;  ///< on a processor
  double waited =
      0;  ///< ready to run while others had them; of a wait it tells when that has ended

  bool operator==(const ThreadTimes&) const = default;
};

/// A thread as the system lists it.
struct ThreadEntry {
  pid_t id = 0;
  bool ready = false;  ///< it runs, or waits for nothing but a processor
  ThreadTimes times;
};

/// The threads of a process that are there now.
std::vector<ThreadEntry> list_threads(const ProcessEntry& process);

/// Those of the thread that calls.
ThreadTimes own_times();

/// What the kernel keeps to find a process's pages, which no limit and no resident size counts: 0
/// when it is gone.
std::size_t page_table_bytes(pid_t id);

/// Whether a process runs under this user id, really, effectively or by what it has saved.
bool has_process_of(uid_t user);

}  // namespace carlo::grader
