#pragma once

#include <optional>
#include <string>

namespace carlo {

/// Returns whether a user is present: stdin and stdout are a terminal that can do more than
/// TERM=dumb.
bool at_terminal();

/// Reads single keys without echo while it exists: no line editing, the cursor hidden. Restores the
/// terminal when it ends, even by an exception or a crash; Ctrl-C remains a signal. Only one at a
/// time.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Releases the terminal and takes it again, around a stop by Ctrl-Z.
  void release();
  void acquire();

  /// Returns the keys pressed, except those that send several characters (arrows); none if the
  /// terminal is gone.
  std::optional<std::string> keys();
};

struct ScreenSize {
  int columns = 80, rows = 24;
};
ScreenSize screen_size();

}  // namespace carlo
