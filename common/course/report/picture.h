#pragma once

#include "image/image.h"

#include <string>

namespace carlo {

/// An image of linear radiances from 0 (black) to `white` for a page: the address of a PNG that
/// holds it, what `src="..."` wants. Throws Error when memory is short.
std::string picture_url(const Image& image, double white);

}  // namespace carlo
