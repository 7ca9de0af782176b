#pragma once

#include "image/image.h"

#include <string>

namespace carlo {

/// Returns a PNG data URL, for `src="..."`, of an image of linear radiances from 0 (black) to
/// `white`. Throws Error when memory is short.
std::string picture_url(const Image& image, double white);

}  // namespace carlo
