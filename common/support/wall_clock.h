#pragma once

#include <chrono>

namespace carlo {

/// Seconds that have gone by since it was made. What a thread's own work takes says Stopwatch.
class WallClock {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
};

}  // namespace carlo
