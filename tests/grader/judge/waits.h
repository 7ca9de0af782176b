#pragma once

#include "grader/judge/watch.h"

#include <sys/types.h>

#include <map>

namespace carlo::grader {

/// What processes that are watched wait for a processor while others have them all.
class Waits {
 public:
  /// Looks at all threads, `passed` seconds after the last time, or after they were started.
  /// Returns for how many of these seconds one was ready to run and did not, of the thread that had
  /// to wait longest. As of late: those that start one another wait in turn, and each for little.
  double look(const Family& family, double passed);

  /// Seconds of the thread that ran longest.
  double longest_run() const { return longest_run_; }

 private:
  struct Thread {
    ThreadTimes times;
    double in_line = 0;  ///< for which it has been ready and has not moved, until now
    double counted = 0;  ///< of its wait
  };
  static double newly_waited(Thread& thread, const ThreadEntry& entry, double passed);

  std::map<pid_t, Thread> threads_;
  double longest_run_ = 0;
};

}  // namespace carlo::grader
