#pragma once

#include "course/report/plot.h"
#include "image/image.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Returns pictures side by side where the screen is wide enough, each at least `narrowest` rem
/// wide; 0: small enough that about five fit in a row.
std::string tiles(const std::vector<std::string>& pictures, double narrowest = 0);

/// The size of a plot on a tile.
constexpr Size tile_size{280, 180};

/// Returns a tile: a drawing (trusted) below its title and one line.
std::string tile(std::string_view title, std::string_view note, std::string_view drawing);

std::string tile(std::string_view title, std::string_view note, const Plot& plot);

/// Returns a tile: bars of equal width, heights as densities, under the density's line; shown up to
/// `top`.
std::string histogram_tile(std::string_view title, std::string_view note, Stretch across,
                           double top, std::span<const double> bars,
                           const std::function<double(double)>& density);

/// Returns a tile: an image, linear values from 0 (black) to `white`.
std::string image_tile(std::string_view title, std::string_view note, const Image& image,
                       double white);
/// Makes an image from grey values, row 0 at the top.
Image grey_image(std::span<const double> values, std::size_t width);

}  // namespace carlo
