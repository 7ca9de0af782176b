#pragma once

#include <string>
#include <string_view>

namespace carlo {

/// Text as HTML content or attribute value.
std::string html_escaped(std::string_view text);

/// The same, with formulas set as such: x^7, N^(-1/2) and 1.5e-3 with raised exponents, a minus
/// before numbers. The text is what a terminal shows as it is.
std::string html_typeset(std::string_view text);

/// Code that may stand inside a script element: "</script" and "<!--" no longer end it.
std::string script_escaped(std::string_view code);

/// The JSON text as it may stand inside a script element; it parses to the same value.
std::string json_for_html(std::string_view json);

}  // namespace carlo
