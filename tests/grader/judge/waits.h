#pragma once

#include "grader/judge/watch.h"

#include <sys/types.h>

#include <map>

namespace carlo::grader {

/// How long watched processes wait for a processor while others have them all.
class Waits {
 public:
  /// Looks at all threads, `passed` seconds after the last time, or after they were started.
  /// Returns for how many of these seconds the longest-waiting thread was ready to run and did not.
  /// It may be another thread each time: those that start one another wait in turn, each for
  /// little.
  double look(const Family& family, double passed);

  /// Returns the seconds of the longest-running thread.
  double longest_run() const { return longest_run_; }

 private:
  struct Thread {
    ThreadTimes times;
    double in_line = 0;  ///< seconds for which it has been ready without moving, until now
    double counted = 0;  ///< the part of its wait already returned
  };
  static double newly_waited(Thread& thread, const ThreadEntry& entry, double passed);

  std::map<pid_t, Thread> threads_;
  double longest_run_ = 0;
};

}  // namespace carlo::grader
