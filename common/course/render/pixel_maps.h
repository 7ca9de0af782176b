#pragma once

#include "image/film.h"
#include "image/image.h"

namespace carlo {

/// A picture of where the noise is: the standard error of each pixel over its mean, on a
/// logarithmic scale from 0.1 % (dark blue) to 100 % (yellow), as sRGB-encodable linear colours.
/// Grey: not known, for want of samples.
Image error_map(const Film& film);

/// A picture of where the samples went: the number of samples of each pixel on a logarithmic scale
/// from the least (dark blue) to the most (yellow), as sRGB-encodable linear colours. Where all
/// have as many, the middle of the scale.
Image samples_map(const Film& film);

}  // namespace carlo
