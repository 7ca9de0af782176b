#pragma once

#include "stratification.h"

#include <string>
#include <string_view>
#include <vector>

namespace lab04 {

// Pictures of the unit square as HTML for a page: SVG in the page's own colours.

/// One tile: points over a grid of `lines` by `lines` cells, with each point's coordinates marked
/// at the edges.
std::string point_picture(std::string_view title, std::string_view note,
                          const std::vector<Point>& points, int lines);

/// The integrand drawn under the strata: the quarter disc, or the peak.
enum class Background { disc, peak };

/// One tile: the strata as boxes, darker the denser their points, over the integrand.
std::string strata_picture(std::string_view title, std::string_view note,
                           const std::vector<Stratum>& strata, Background background);

}  // namespace lab04
