#pragma once

#include <unistd.h>

#include <string_view>

namespace carlo {

/// Writes to stderr with only what a signal handler may call.
inline void say_in_handler(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

}  // namespace carlo
