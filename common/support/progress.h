#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace carlo {

/// The time that work still takes, by the steps it has reported. Times are in seconds from its
/// start; `now` never falls.
class RemainingTime {
 public:
  /// Reports the `fraction` of the work done, in [0, 1].
  void update(double fraction, double now);
  /// Returns the estimate, in seconds, or nothing while too little is done.
  std::optional<double> estimate(double now) const;
  double fraction() const { return fraction_; }

 private:
  double fraction_ = 0, last_step_ = 0;  ///< done, and by how much the last report raised it
  double last_step_at_ = 0;
};

/// Progress with the remaining time, on stderr. On a terminal it is a bar, redrawn in place at most
/// ten times a second and at least once, elsewhere a line every ten seconds; both go on while
/// nothing is reported. Not thread-safe: only one thread may report.
class Progress {
 public:
  /// `line_every`: the time between two lines where stderr is no terminal.
  Progress(std::string label, bool enabled,
           std::chrono::milliseconds line_every = std::chrono::seconds(10));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Reports the `fraction` of the work done, in [0, 1].
  void update(double fraction);
  /// Clears the line, for text; it is drawn again by update(), or after a second.
  void clear();

  /// From now on, if nothing is reported or cleared for some seconds, the line says for how long.
  void report_stalls();
  /// Clears the line and stops reporting stalls.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(const std::string& more, int width = 30);
  void erase();
  double seconds() const;  ///< since the start
  std::string remaining() const;
  void keep_drawing();
  void print_lines(std::chrono::milliseconds every);

  std::string label_;
  bool enabled_, bar_;  ///< a bar, or lines
  bool drawn_ = false, finished_ = false, stalls_ = false;
  RemainingTime time_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_draw_, last_report_ = Clock::now();
  std::mutex mutex_;  ///< guards everything above
  std::condition_variable woken_;
  std::thread watcher_;
};

/// Formats seconds for people: "830 ms", "12.3 s", "4 min 10 s", "2 h 5 min".
std::string format_seconds(double seconds);

}  // namespace carlo
