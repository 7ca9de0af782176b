#pragma once

#include "image/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace lab08 {

// Pictures as HTML for a page, as wide as the page lets them be.

/// The frame for pictures that stand side by side where the screen is wide enough.
std::string tiles(const std::vector<std::string>& pictures);

/// One picture; linear values from 0 (black) to `white`.
std::string image_picture(std::string_view title, std::string_view note, const carlo::Image& image,
                          double white);

}  // namespace lab08
