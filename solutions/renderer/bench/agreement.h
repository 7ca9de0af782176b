#pragma once

#include "image/image.h"

#include <vector>

namespace bench {

/// The disagreement of two renderers' images of one scene.
struct Agreement {
  double tile_z = 0;      ///< the largest |z| of a tile's channel
  double mean_z = 0;      ///< the largest |z| of the whole image's mean, over channels
  double mean_ratio = 1;  ///< of the sums over pixels and channels
  bool holds() const;
};

/// Tiles have 16 x 16 pixels.
constexpr int agreement_tile = 16;
/// With the channels of 192 tiles, equal scenes fail by chance once in ten thousand times: 1.1e-4
/// for a tile beyond 5 standard errors, 1.7e-6 for a mean of three channels beyond 5.
constexpr double agreement_limit = 5;

/// Compares the mean of `images`, two or more of equal size and different seeds, with a reference
/// image and its standard error. The spread of each pixel over the images gives their standard
/// error: a tile adds up 256 pixels, so z is close to normal even with three images. A difference
/// that no noise explains (both standard errors 0) is infinite. Throws Error when sizes differ.
Agreement agreement(const std::vector<carlo::Image>& images, const carlo::Image& reference,
                    const carlo::Image& reference_error);

/// The reference's own contribution to relMSE (image/metrics.h) against it.
double rel_mse_noise(const carlo::Image& reference, const carlo::Image& reference_error);

/// A number of samples per pixel, their time and the remaining error.
struct Rung {
  double samples = 0, seconds = 0, rel_mse = 0;
};

/// Samples and seconds at the error `rel_mse`, interpolated between two measurements by straight
/// lines on logarithmic axes. Outside the two, seconds x relMSE of the nearer one is kept.
Rung at_error(const Rung& fewer, const Rung& more, double rel_mse);

}  // namespace bench
