#pragma once

#include <string>
#include <string_view>

namespace carlo {

/// Return whether colours and progress bars are suitable for this stream: it is a terminal, TERM is
/// not "dumb" and (for colours) NO_COLOR is not set.
bool stderr_is_interactive();
bool stdout_has_colour();

enum class Colour { red, green, yellow, blue, bold, dim };

/// Returns `text` in the colour if stdout shows colours, else unchanged.
std::string coloured(Colour colour, std::string_view text);

}  // namespace carlo
