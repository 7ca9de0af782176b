#pragma once

#include <string>
#include <string_view>

namespace carlo {

/// Escapes text as HTML content or attribute value.
std::string html_escaped(std::string_view text);

/// Escapes text and typesets formulas: x^7, N^(-1/2) and 1.5e-3 with raised exponents, a minus
/// before numbers. A terminal shows the same text unchanged.
std::string html_typeset(std::string_view text);

/// Escapes code for a script element: "</script" and "<!--" no longer end it.
std::string script_escaped(std::string_view code);

/// Escapes JSON text for a script element; it parses to the same value.
std::string json_for_html(std::string_view json);

}  // namespace carlo
