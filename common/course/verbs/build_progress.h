#pragma once

#include <string>

namespace carlo::verbs {

/// How far a build is, as it says itself ("@done/total seconds ..."): one line on a terminal,
/// elsewhere one each half minute.
class BuildProgress {
 public:
  BuildProgress();
  /// False for a line that tells something else.
  bool takes(const std::string& line);
  /// Removes the terminal's line.
  void clear();

 private:
  bool terminal_, shown_ = false;
  int told_ = 0;  ///< the second of the last line
};

/// ", about 3 min left": what is left of a build of which `done` of `total` steps took `seconds`;
/// nothing while that would be a guess.
std::string time_left(int done, int total, int seconds);

}  // namespace carlo::verbs
