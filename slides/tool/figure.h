#pragma once

#include <string>

namespace carlo {

/// Draws a plot, given as JSON as plot.mjs writes it, like those of the labs' pages. Returns SVG.
std::string figure_svg(const std::string& json);

}  // namespace carlo
