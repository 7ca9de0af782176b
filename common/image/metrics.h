#pragma once

#include "image/image.h"

#include <array>
#include <vector>

namespace carlo {

/// The difference between an image and a reference of the same size; means over pixels and
/// channels.
struct ImageError {
  double mse = 0;
  double rel_mse = 0;            ///< of (a - r)^2 / (r^2 + 0.01)
  std::array<double, 3> mean{};  ///< of the image, per channel
  std::array<double, 3> reference{};
};

/// Throws Error when the sizes differ. NaN in either image makes the result NaN.
ImageError compare(const Image& image, const Image& reference);

/// The difference of the means of two images in standard errors of that difference, per channel,
/// from the standard errors of the two images' pixels. `extra_variance`: the variance of the
/// image's mean beyond that of independent pixels.
std::array<double, 3> bias_z(const Image& image, const Image& standard_error,
                             const Image& reference, const Image& reference_error,
                             const std::array<double, 3>& extra_variance = {});

/// The same for each tile of `tile` x `tile` pixels, tiles row by row, three channels per tile.
std::vector<double> tile_z(const Image& image, const Image& standard_error, const Image& reference,
                           const Image& reference_error, int tile);

/// The number of pixels with a channel that is NaN or infinite.
std::size_t count_non_finite(const Image& image);

}  // namespace carlo
