#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carlo {

/// Columns that UTF-8 text without colours takes on a terminal; each code point counts as one.
std::size_t display_width(std::string_view text);

/// `text` in at most `most` >= 1 columns; where something is left out, "…" stands at its end.
std::string shortened(const std::string& text, std::size_t most);

/// Without colours and what else a terminal is told (ESC ... m or K).
std::string without_escapes(std::string_view text);

/// `text` for a screen of `columns`: longer lines go on below, indented like their beginning and
/// parted at spaces where that is possible. Colours (ESC [ ... m) take no room. Every line ends.
std::string wrapped_to(const std::string& text, int columns);

/// How wide the terminal is that stdout is; 0 where it is none.
int stdout_columns();

/// How much of a title stands in a line of stdout whose other parts take `others` columns: all of
/// it where there is no terminal, and no less than `least`.
std::size_t room_beside(std::size_t others, std::size_t least);

/// Wrapped to the terminal that stdout is, and to `most` columns there and elsewhere (0: as wide as
/// it is). What stands behind the last line end, as a prompt does, stays without one.
std::string wrapped(const std::string& text, int most = 0);

/// Its first `rows` lines; where there are more, the last of them says how many and `what` shows
/// them.
std::string first_rows(const std::string& text, int rows, const std::string& what);

}  // namespace carlo
