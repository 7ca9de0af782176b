#pragma once

#include <optional>
#include <string>

namespace carlo {

/// Whether somebody sits there: stdin and stdout are a terminal that can do more than TERM=dumb.
bool at_terminal();

/// Keys one by one, unseen, while this lives: no line editing, no echo, the cursor hidden. The
/// terminal is as it was when this ends, also by an exception or a crash; Ctrl-C stays a signal.
/// There is one of these at a time.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Gives the terminal back and takes it again, around a stop by Ctrl-Z.
  void release();
  void acquire();

  /// The keys that were pressed, without those that send more than one character (arrows); nothing
  /// when the terminal is gone.
  std::optional<std::string> keys();
};

struct ScreenSize {
  int columns = 80, rows = 24;
};
ScreenSize screen_size();

}  // namespace carlo
