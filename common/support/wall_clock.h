#pragma once

#include <chrono>

namespace carlo {

/// Measures the seconds since it was made. Stopwatch measures the work of a thread.
class WallClock {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
};

}  // namespace carlo
