#pragma once

#include "image/film.h"
#include "image/image.h"

namespace carlo {

/// A picture of where the noise is: the standard error of each pixel over its mean, on a
/// logarithmic scale from 0.1 % (dark blue) to 100 % (yellow), as sRGB-encodable linear colours.
/// Grey: not known, for want of samples.
Image error_map(const Film& film);

}  // namespace carlo
