#include "support/terminal.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>

namespace carlo {
namespace {

bool terminal(int fd) {
  const char* term = std::getenv("TERM");
  return ::isatty(fd) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

int ansi_code(Colour colour) {
  switch (colour) {
    case Colour::red:
      return 31;
    case Colour::green:
      return 32;
    case Colour::yellow:
      return 33;
    case Colour::blue:
      return 34;
    case Colour::bold:
      return 1;
    case Colour::dim:
      return 2;
  }
  return 0;
}

}  // namespace

bool stderr_is_interactive() {
  return terminal(STDERR_FILENO);
}

bool stdout_has_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return terminal(STDOUT_FILENO) && (no_color == nullptr || *no_color == '\0');
}

std::string coloured(Colour colour, std::string_view text) {
  if (!stdout_has_colour()) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", ansi_code(colour), text);
}

}  // namespace carlo
