#pragma once

#include "image/image.h"

#include <vector>

namespace bench {

/// How far apart two renderers' images of one scene are.
struct Agreement {
  double tile_z = 0;      ///< the largest |z| of a tile's channel
  double mean_z = 0;      ///< the largest |z| of the whole image's mean, over channels
  double mean_ratio = 1;  ///< of the sums over pixels and channels
  bool holds() const;
};

/// Tiles are of 16 x 16 pixels.
constexpr int agreement_tile = 16;
/// The same scene fails by chance once in ten thousand times with 192 tiles' channels: 1.1e-4 for
/// tiles beyond 5 standard errors, 1.7e-6 for a mean of three channels beyond 5.
constexpr double agreement_limit = 5;

/// Compares the mean of `images`, two or more of one size by other seeds, with a reference image
/// and its standard error. Between the images the spread of each pixel gives the standard error: a
/// tile adds up 256 pixels', so that z is close to normal even with three images. A difference that
/// no noise explains (both standard errors 0) is infinitely far. Throws Error when sizes differ.
Agreement agreement(const std::vector<carlo::Image>& images, const carlo::Image& reference,
                    const carlo::Image& reference_error);

/// What the reference's own noise adds to relMSE (image/metrics.h) against it.
double rel_mse_noise(const carlo::Image& reference, const carlo::Image& reference_error);

/// A number of samples a pixel with what they took and the error they left.
struct Rung {
  double samples = 0, seconds = 0, rel_mse = 0;
};

/// Samples and seconds where the error is `rel_mse`, between two measurements: straight lines on
/// logarithmic axes. Beyond the two the nearer one's seconds x relMSE stays.
Rung at_error(const Rung& fewer, const Rung& more, double rel_mse);

}  // namespace bench
