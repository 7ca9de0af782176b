#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace carlo {

/// A progress bar with the remaining time, on stderr. On a terminal it is redrawn in place, at most
/// ten times a second; elsewhere it is silent. Not thread-safe: one thread reports.
class Progress {
 public:
  Progress(std::string label, bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the work done, in [0, 1].
  void update(double fraction);
  /// Clears the line; update() draws it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_;
};

/// Seconds for people: "830 ms", "12.3 s", "4 min 10 s", "2 h 5 min".
std::string format_seconds(double seconds);

}  // namespace carlo
