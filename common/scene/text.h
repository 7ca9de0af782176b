#pragma once

#include "support/quotes.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// True if `text` may be a misspelling of `name`: at most two characters differ, and not all of
/// them.
bool is_near(std::string_view text, std::string_view name);

/// " (did you mean "x"?)" for the candidate nearest to `text`, or " (expected one of ...)" with all
/// candidates if none is near and they are few, or nothing.
std::string suggest(std::string_view text, const std::vector<std::string>& candidates);

/// The byte that ends the lines of a text: LF, or CR if there is no LF, as old Macintoshes wrote.
char end_of_line(std::string_view text);

/// The words of `text`, separated by white space or by any character of `separators`.
std::vector<std::string_view> words(std::string_view text, std::string_view separators = "");

/// All of `text`, except white space around it, as a number, in any locale. Empty for garbage
/// before or after it, for NaN, infinity and numbers outside float's range.
std::optional<double> parse_number(std::string_view text);

/// The same for an integer that fits into an int.
std::optional<int> parse_integer(std::string_view text);

/// The expected kind of number, for a message about a text that parse_number() refuses: "a finite
/// number", or for one that is too large or too small "a number within float's range".
std::string_view number_wanted(std::string_view text);
/// The same for one of several.
std::string_view numbers_wanted(std::string_view text);

}  // namespace carlo
