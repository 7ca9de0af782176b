#pragma once

#include <string>
#include <string_view>

namespace carlo {

/// Whether colours and progress bars belong on this stream: it is a terminal, TERM is not "dumb"
/// and (for colours) NO_COLOR is not set.
bool stderr_is_interactive();
bool stdout_has_colour();

enum class Colour { red, green, yellow, blue, bold, dim };

/// `text` in the colour where stdout shows colours, `text` as it is elsewhere.
std::string coloured(Colour colour, std::string_view text);

}  // namespace carlo
