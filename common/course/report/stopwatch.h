#pragma once

#include <ctime>

namespace carlo {

/// Measures the processor seconds that this program has used since the stopwatch was made, whatever
/// else the machine is busy with.
class Stopwatch {
 public:
  double seconds() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace carlo
