#pragma once

#include <string_view>

namespace carlo::grader {

/// The style sheet of what page.h's does not know, as a style element. Colours are the page's own,
/// so that both colour schemes work.
std::string_view page_style();

}  // namespace carlo::grader
