#pragma once

#include "render/integrator.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tiles {

/// The estimated mean of a tile's pixels in one channel, with the estimate's second and third
/// central moments. They come from the spread of block means within each pixel, so that differences
/// between pixels do not count.
struct Channel {
  double mean = 0, variance = 0, third = 0;
};
using Tile = std::array<Channel, 3>;

struct Estimate {
  std::vector<Tile> tiles;  ///< row by row
  Tile whole;               ///< of the whole image
  carlo::Counts counts;
};

/// The samples of each pixel: `blocks` >= 3 blocks of `block` independent samples.
struct Samples {
  std::uint32_t blocks = 32, block = 8;
  std::uint32_t per_pixel() const { return blocks * block; }
};

/// Renders size x size pixels in tiles of tile x tile, which divides size; on all cores, with the
/// same bits for any number of them. Where four pixels `share` paths, variances are four times
/// those of independent ones, which is the most that is possible.
Estimate estimate(const carlo::Integrator& integrator, int size, int tile, Samples samples,
                  bool share = false);

/// The difference of two independent estimates in standard errors; 0 where both are equal.
double z(const Channel& a, const Channel& b);

/// The skewness of the difference.
double skewness(const Channel& a, const Channel& b);

/// The probability of |z| > limit if the difference has a small skewness. Since z is divided by a
/// standard error from the same samples, its two tails are about exp(+-skewness limit^3 / 3) times
/// the normal ones. Source: Jing, Shao, Wang, "Self-normalized Cramer-type large deviations for
/// independent random variables", Annals of Probability 31, 2003.
double tail(double limit, double skewness);

}  // namespace tiles
