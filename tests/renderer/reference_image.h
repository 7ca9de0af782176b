#pragma once

#include "image/exr.h"
#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace reference_image {

using carlo::Image;

/// Reference images are square, with this many pixels per side, and made from independent samples,
/// so that their standard errors are unbiased, not bounds.
constexpr int size = 128;

/// `x` in multiples of the power of two at or below `step`; step > 0.
inline float rounded(float x, float step) {
  const float unit = std::exp2(std::floor(std::log2(step)));
  return std::round(x / unit) * unit;
}

/// Removes the digits that are only noise, and would not compress, according to the standard
/// errors: values in steps of at most 1/8 of their standard error (it grows by less than 0.1 %),
/// standard errors in steps of at most 1/128.
inline void drop_noise_digits(carlo::ExrFile& file) {
  for (std::size_t i = 0; i < file.image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      float& error = file.standard_error->pixels[i][c];
      if (!(error > 0)) continue;
      float& value = file.image.pixels[i][c];
      value = rounded(value, error / 8);
      error = rounded(error, error / 128);
    }
  }
}

/// The mean over the non-black pixels of standard error / value, both summed over channels.
inline double mean_relative_error(const Image& image, const Image& error) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const carlo::Rgb value = image.pixels[i], e = error.pixels[i];
    if (!(value.r + value.g + value.b > 0)) continue;
    sum += static_cast<double>(e.r + e.g + e.b) / static_cast<double>(value.r + value.g + value.b);
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

/// The image at half its width and height: means of 2 x 2 pixels.
inline Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      half.at(x, y) = (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                       image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1)) /
                      4.0f;
    }
  }
  return half;
}

/// The largest |z|; NaN if one is.
template <class Range>
double largest(const Range& z) {
  double worst = 0;
  for (const double x : z) {
    if (!(std::abs(x) <= worst)) worst = std::abs(x);
  }
  return worst;
}

}  // namespace reference_image
