#pragma once

#include "course/verdict/figure.h"

#include <string>

namespace carlo::grader {

/// A figure as HTML: title, drawing, key, note, and its numbers folded away below. All its text is
/// escaped.
std::string figure_html(const Figure& figure);

}  // namespace carlo::grader
