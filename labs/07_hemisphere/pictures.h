#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lab07 {

// Pictures as HTML for a page, as wide as the page lets them be.

/// The frame for tiles, each at least `width` rem wide, side by side where the screen is wide
/// enough.
std::string tiles(const std::vector<std::string>& pictures, int width);

/// One tile: bars of equal width from `first` to `last`, heights as densities, under the density.
std::string histogram_picture(std::string_view title, std::string_view note, double first,
                              double last, std::span<const double> bars,
                              const std::function<double(double)>& pdf);

/// One tile: an image, row 0 at the top, linear values from 0 (black) to `white`.
std::string image_picture(std::string_view title, std::string_view note,
                          std::span<const double> image, int width, double white);

}  // namespace lab07
