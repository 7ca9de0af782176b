#pragma once

#include "image/image.h"

#include <span>
#include <string>

namespace carlo {

/// Packs floats as text for a page: each rounded to its upper 24 bits (relative error 8e-6; NaN
/// stays NaN), the first byte of all of them, then the second, then the third, deflated, in base64.
/// web/viewer_pixels.js reads it. Throws Error when memory is short.
std::string packed(std::span<const float> values);

/// Packs an image: all of R, then all of G, then all of B.
std::string packed(const Image& image);

}  // namespace carlo
