#pragma once

#include <string>
#include <string_view>

// Words from verdicts, which a student's program may have had a hand in, for HTML.

namespace carlo::grader {

/// The text with spaces for control characters but for line ends and tabs.
std::string printable(std::string_view text);

/// Printable text as HTML content or attribute value.
std::string html(std::string_view text);

}  // namespace carlo::grader
