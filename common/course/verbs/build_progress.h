#pragma once

#include <string>

namespace carlo::verbs {

/// Shows a build's progress as reported by ninja ("@done/total seconds ..."): in one line on a
/// terminal, elsewhere as one line every ten seconds.
class BuildProgress {
 public:
  BuildProgress();
  /// Returns false if the line reports no progress.
  bool takes(const std::string& line);
  /// Clears the terminal's line.
  void clear();

 private:
  bool terminal_, shown_ = false;
  int told_ = 0;  ///< the second at which a line was printed last
};

/// Returns ", about 3 min left" for a build of which `done` of `total` steps took `seconds`; ""
/// while that would be a guess.
std::string time_left(int done, int total, int seconds);

}  // namespace carlo::verbs
