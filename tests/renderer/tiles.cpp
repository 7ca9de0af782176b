#include "tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tiles {
namespace {

/// Adds the mean of one pixel's blocks, and its moments, to the tile's sums.
void add_pixel(const std::vector<double>& blocks, Channel& sum) {
  const auto n = static_cast<double>(blocks.size());
  double mean = 0, squares = 0, cubes = 0;
  for (const double x : blocks)
    mean += x / n;
  for (const double x : blocks) {
    const double d = x - mean;
    squares += d * d;
    cubes += d * d * d;
  }
  // Unbiased cumulants of a block, and with them those of the mean of n.
  sum.mean += mean;
  sum.variance += squares / (n - 1) / n;
  sum.third += cubes * n / ((n - 1) * (n - 2)) / (n * n);
}

void divide(Channel& sum, double count) {
  sum.mean /= count;
  sum.variance /= count * count;
  sum.third /= count * count * count;
}

Tile estimate_tile(const carlo::Integrator& integrator, carlo::Tile tile, Samples samples,
                   carlo::Counts& counts) {
  const auto pixels = static_cast<std::size_t>((tile.x1 - tile.x0) * (tile.y1 - tile.y0));
  std::vector<std::array<double, 3>> means(pixels);
  std::vector<std::vector<double>> blocks(3 * pixels);
  tile.samples = samples.block;
  for (std::uint32_t b = 0; b < samples.blocks; ++b) {
    tile.first_sample = b * samples.block;
    integrator.render(tile, means, counts);
    for (std::size_t i = 0; i < 3 * pixels; ++i)
      blocks[i].push_back(means[i / 3][i % 3]);
  }
  Tile result;
  for (std::size_t i = 0; i < 3 * pixels; ++i)
    add_pixel(blocks[i], result[i % 3]);
  for (Channel& channel : result)
    divide(channel, static_cast<double>(pixels));
  return result;
}

}  // namespace

Estimate estimate(const carlo::Integrator& integrator, int size, int tile, Samples samples,
                  bool share) {
  const int columns = size / tile;
  Estimate result;
  result.tiles.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns));
  std::vector<carlo::Counts> counts(result.tiles.size());
  tbb::parallel_for(std::size_t{0}, result.tiles.size(), [&](std::size_t i) {
    const int x = static_cast<int>(i) % columns * tile, y = static_cast<int>(i) / columns * tile;
    result.tiles[i] = estimate_tile(
        integrator, {.x0 = x, .y0 = y, .x1 = x + tile, .y1 = y + tile, .share = share}, samples,
        counts[i]);
    for (Channel& channel : result.tiles[i])
      channel.variance *= share ? 4 : 1;
  });
  for (std::size_t i = 0; i < counts.size(); ++i) {
    result.counts += counts[i];
    for (std::size_t c = 0; c < 3; ++c) {
      result.whole[c].mean += result.tiles[i][c].mean;
      result.whole[c].variance += result.tiles[i][c].variance;
      result.whole[c].third += result.tiles[i][c].third;
    }
  }
  for (Channel& channel : result.whole)
    divide(channel, static_cast<double>(counts.size()));
  return result;
}

double z(const Channel& a, const Channel& b) {
  const double difference = a.mean - b.mean;
  return difference == 0 ? 0 : difference / std::sqrt(a.variance + b.variance);
}

double skewness(const Channel& a, const Channel& b) {
  const double variance = a.variance + b.variance;
  return variance == 0 ? 0 : (a.third - b.third) / (variance * std::sqrt(variance));
}

double tail(double limit, double skewness) {
  const double normal = std::erfc(limit / std::sqrt(2.0));
  return std::min(1.0, normal * std::cosh(skewness * limit * limit * limit / 3));
}

}  // namespace tiles
