#pragma once

#include <string>

namespace carlo {

/// While this exists, Ctrl-C prints on stderr in which experiment the program was stopped, that no
/// results were written, and `advice`, then ends the program as SIGINT does. Only one may exist at
/// a time. If SIGINT is already ignored, it stays so.
class StopNote {
 public:
  explicit StopNote(const std::string& advice);
  ~StopNote();
  StopNote(const StopNote&) = delete;
  StopNote& operator=(const StopNote&) = delete;
};

}  // namespace carlo
