#pragma once

#include "random/rng.h"

#include <cstddef>
#include <cstdint>
#include <vector>

// The questions of Lab 9.2's probes, which its checks compute again from the probe's seed.

namespace lab09_pixels {

/// A filter, like the contract's PixelFilter; curves are numbered as there.
struct FilterCase {
  int curve;
  double radius, sigma;
};
constexpr int box_curve = 0, tent_curve = 1, gaussian_curve = 2;

/// One filter of each curve, the Gaussian cut where it still matters; then a box of one pixel, and
/// Gaussians that are cut as late as the contract allows, or are nearly boxes.
constexpr std::size_t plain_filters = 3;
inline std::vector<FilterCase> drawn_filters(std::uint64_t seed) {
  carlo::Rng rng(seed, 1);
  const auto radius = [&] { return 1.1 + 0.7 * rng.uniform(); };
  const double box = radius(), tent = radius(), gaussian = radius(), late = radius(),
               wide = radius(), flat = radius();
  return {{box_curve, box, 0.4},
          {tent_curve, tent, 0.4},
          {gaussian_curve, gaussian, 0.6 * gaussian},
          {box_curve, 0.5, 0.4},
          {gaussian_curve, late, late / 6},
          {gaussian_curve, wide, 10 * wide},
          {gaussian_curve, flat, 1000 * flat}};
}

struct PixelPoint {
  double x, y;
};

/// Points at which filter_value() is tested, as fractions of the radius. Each of the first is
/// followed by its mirror images (-x, y), (x, -y) and (y, x); then come points outside the circle
/// but inside the square, and beyond the radius in only one direction.
constexpr std::size_t mirrored_points = 8, corner_points = 4, outer_points = 8;
inline std::vector<PixelPoint> drawn_points(std::uint64_t seed) {
  carlo::Rng rng(seed, 2);
  std::vector<PixelPoint> points;
  for (std::size_t i = 0; i < mirrored_points; ++i) {
    const double x = 0.05 + 0.6 * rng.uniform(), y = 0.05 + 0.6 * rng.uniform();
    for (const PixelPoint p : {PixelPoint{x, y}, {-x, y}, {x, -y}, {y, x}})
      points.push_back(p);
  }
  for (std::size_t i = 0; i < corner_points; ++i) {
    const double side = i % 2 == 0 ? 1 : -1, x = 0.75 + 0.2 * rng.uniform();
    points.push_back({side * x, 0.75 + 0.2 * rng.uniform()});
  }
  for (std::size_t i = 0; i < outer_points; ++i) {
    const double side = i % 4 < 2 ? 1 : -1, out = side * (1.01 + 2 * rng.uniform());
    const double in = 0.9 * rng.uniform();
    points.push_back(i % 2 == 0 ? PixelPoint{out, in} : PixelPoint{in, out});
  }
  return points;
}

/// Pairs of numbers for offsets: the last ones are the ends of [0, 1) and its middle.
constexpr std::size_t end_pairs = 4;
inline std::vector<PixelPoint> drawn_pairs(std::uint64_t seed) {
  carlo::Rng rng(seed, 3);
  std::vector<PixelPoint> pairs;
  for (int i = 0; i < 24; ++i) {
    const auto u = static_cast<double>(rng.uniform_float());
    pairs.push_back({u, static_cast<double>(rng.uniform_float())});
  }
  constexpr double last = 1 - 0x1p-24;
  for (const PixelPoint p : {PixelPoint{0, last}, {last, 0}, {0, 0.5}, {0.5, last}})
    pairs.push_back(p);
  return pairs;
}

/// The film of the probes: 2 wide and high at distance 1, with pixels that are not square.
constexpr int film_width = 16, film_height = 8;

/// The radiances of a pixel's rays, in order: red is the same for all.
struct RayRadiance {
  double r, g, b;
};
inline std::vector<RayRadiance> drawn_radiance(std::uint64_t seed, std::int64_t rays) {
  carlo::Rng rng(seed, 4);
  const auto same = static_cast<double>(0.5f + rng.uniform_float());
  std::vector<RayRadiance> all;
  for (std::int64_t i = 0; i < rays; ++i) {
    const auto g = static_cast<double>(rng.uniform_float());
    all.push_back({same, g, i % 2 == 0 ? 4.0 : 1.0});
  }
  return all;
}

/// The position of an edge through a pixel, from its middle to the right, as a fraction of the
/// radius.
inline double drawn_edge(std::uint64_t seed) {
  return 0.15 + 0.3 * carlo::Rng(seed, 5).uniform();
}

}  // namespace lab09_pixels
