#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carlo {

/// Returns how many terminal columns UTF-8 text without colours takes; each code point counts as
/// one.
std::size_t display_width(std::string_view text);

/// Shortens `text` to at most `most` >= 1 columns; "…" at the end marks an omission.
std::string shortened(const std::string& text, std::size_t most);

/// Removes colours and other terminal sequences (ESC ... m or K).
std::string without_escapes(std::string_view text);

/// Wraps `text` for a screen of `columns`: continuation lines are indented like the line they
/// continue, and break at spaces where possible. Colours (ESC [ ... m) take no columns. Every line
/// ends in '\n'.
std::string wrapped_to(const std::string& text, int columns);

/// Returns the width of the terminal that stdout is; 0 if it is none.
int stdout_columns();

/// Returns how many columns a title may take in a line of stdout whose other parts take `others`:
/// no limit without a terminal, and never less than `least`.
std::size_t room_beside(std::size_t others, std::size_t least);

/// Wraps to the terminal that stdout is, and to at most `most` columns there and elsewhere (0: only
/// the terminal's width). Text after the last line end, such as a prompt, gets no line end.
std::string wrapped(const std::string& text, int most = 0);

/// Returns the first `rows` lines; if there are more, the last line says how many and that `what`
/// shows them.
std::string first_rows(const std::string& text, int rows, const std::string& what);

}  // namespace carlo
