#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace carlo::verbs {

/// How many steps are done, of how many.
struct Step {
  int done = 0, total = 0;
};

/// Returns the step in a text that begins "DONE/TOTAL ", blanks before it skipped, as ninja and
/// ctest report it.
std::optional<Step> step_in(std::string_view text);

/// Progress on stderr of work that another program does in steps, "carlo: building 3/10, about 20 s
/// left": redrawn in place on a terminal, elsewhere a line every ten seconds.
class StepProgress {
 public:
  explicit StepProgress(std::string doing);
  /// From now on `step` is shown; at once on a terminal.
  void report(const Step& step);
  /// Shows it on a terminal; elsewhere if nothing has been shown for ten seconds.
  void show();
  /// Clears the terminal's line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string doing_;
  bool terminal_, shown_ = false;
  Step step_;
  Clock::time_point start_ = Clock::now(), last_line_ = start_, last_step_ = start_;
};

}  // namespace carlo::verbs
