#pragma once

#include <string>

namespace carlo {

/// `text` for a screen of `columns`: longer lines go on below, indented like their beginning and
/// parted at spaces where that is possible. Colours (ESC [ ... m) take no room.
std::string wrapped_to(const std::string& text, int columns);

/// Its first `rows` lines; where there are more, the last of them says how many and `what` shows
/// them.
std::string first_rows(const std::string& text, int rows, const std::string& what);

}  // namespace carlo
