#pragma once

#include "image/film.h"
#include "image/image.h"

namespace carlo {

/// Draws where the noise is: the standard error of each pixel over its mean, on a logarithmic scale
/// from 0.1 % (dark blue) to 100 % (yellow), as linear colours within sRGB. Pixels with too few
/// samples for an error are grey.
Image error_map(const Film& film);

/// Draws where the samples went: the number of samples of each pixel, on a logarithmic scale from
/// the least (dark blue) to the most (yellow), as linear colours within sRGB. If all pixels have
/// the same number, the map is the middle of the scale.
Image samples_map(const Film& film);

}  // namespace carlo
