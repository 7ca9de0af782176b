#pragma once

#include <string>
#include <string_view>

// Prepares text from verdicts, which a student's program may have influenced, for HTML.

namespace carlo::grader {

/// Replaces control characters except line ends and tabs by spaces.
std::string printable(std::string_view text);

/// Returns printable text as HTML content or attribute value.
std::string html(std::string_view text);

}  // namespace carlo::grader
