#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

// Words from verdicts, which a student's program may have had a hand in, for HTML.

namespace carlo::grader {

/// The text with spaces for control characters but for line ends and tabs.
std::string printable(std::string_view text);

/// Printable text as HTML content or attribute value.
std::string html(std::string_view text);

/// The member's text; "" when there is no such member or it is no text.
std::string text_in(const nlohmann::json& object, const char* key);

/// The member's number as "2" or "1.5"; "?" when there is none.
std::string number_in(const nlohmann::json& object, const char* key);

/// The member as a list; an empty one when there is none.
const nlohmann::json& list_in(const nlohmann::json& object, const char* key);

/// Whether the member is true.
bool true_in(const nlohmann::json& object, const char* key);

}  // namespace carlo::grader
