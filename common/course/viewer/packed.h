#pragma once

#include "image/image.h"

#include <span>
#include <string>
#include <string_view>

// Numbers and images as text in a page.

namespace carlo {

/// Encodes bytes as text, RFC 4648.
std::string base64(std::string_view bytes);

/// Packs floats as text for a page: each rounded to its upper 24 bits (relative error 8e-6; NaN
/// stays NaN), the first byte of all of them, then the second, then the third, deflated, in base64.
/// web/viewer_pixels.js reads it. Throws Error when memory is short.
std::string packed(std::span<const float> values);

/// Packs an image: all of R, then all of G, then all of B.
std::string packed(const Image& image);

/// Returns a PNG data URL, for `src="..."`, of an image of linear radiances from 0 (black) to
/// `white`. Throws Error when memory is short.
std::string picture_url(const Image& image, double white);

}  // namespace carlo
