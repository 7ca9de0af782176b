#pragma once

namespace carlo {

/// While this lives, Ctrl-C says on stderr in which experiment the program was stopped and that no
/// results were written, and ends it as SIGINT does. There is one of these at a time. Where SIGINT
/// is ignored already it stays so.
class StopNote {
 public:
  StopNote();
  ~StopNote();
  StopNote(const StopNote&) = delete;
  StopNote& operator=(const StopNote&) = delete;
};

}  // namespace carlo
