#pragma once

#include "course/verdict/figure.h"

#include <string>

namespace carlo::grader {

/// Returns a figure as HTML: title, drawing, key, note, and its numbers folded below. Escapes all
/// its text.
std::string figure_html(const Figure& figure);

}  // namespace carlo::grader
