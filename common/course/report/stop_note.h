#pragma once

#include <string>

namespace carlo {

/// While this lives, Ctrl-C says on stderr in which experiment the program was stopped, that no
/// results were written and then `advice`, and ends it as SIGINT does. There is one of these at a
/// time. Where SIGINT is ignored already it stays so.
class StopNote {
 public:
  explicit StopNote(const std::string& advice);
  ~StopNote();
  StopNote(const StopNote&) = delete;
  StopNote& operator=(const StopNote&) = delete;
};

}  // namespace carlo
