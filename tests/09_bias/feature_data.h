#pragma once

#include "random/rng.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// The questions of Lab 9.3's probes, which its checks compute again. They follow from the probe's
// seed, so that the answers cannot be known beforehand.

namespace lab09_features {

using Three = std::array<float, 3>;

/// A pixel, as in bias.h.
struct Pixel {
  Three color{}, variance{}, albedo{}, normal{};
  float depth = 0;
};

/// FilterStrength without its radius.
struct Strength {
  double color = 1, albedo = 0.1, normal = 0.1, depth = 0.05;
};

struct Pair {
  Pixel one, other;
  Strength strength;
};

/// How the pixels of a pair differ.
enum PairKind {
  nothing,
  albedo,
  normal,
  depth,
  no_depth,    ///< not at all; both see the sky
  sky,         ///< one of them sees the sky
  color,       ///< in colour, beyond their noise
  noise,       ///< in colour, within their noise
  one_sure,    ///< one has no variance
  both_sure,   ///< neither has: the weight is 0
  same_sure,   ///< neither has, and the colours are equal
  everything,  ///< a little in everything
  pair_kinds
};

inline Three drawn_three(carlo::Rng& rng, double low, double high) {
  Three out;
  for (float& x : out)
    x = static_cast<float>(low + (high - low) * rng.uniform());
  return out;
}

inline Three drawn_normal(carlo::Rng& rng) {
  const double z = 2 * rng.uniform() - 1, angle = 6.28318530718 * rng.uniform();
  const double r = std::sqrt(1 - z * z);
  return {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
          static_cast<float>(z)};
}

/// n, rotated by an angle about some axis.
inline Three turned_normal(const Three& n, double angle) {
  const std::size_t least = std::abs(n[0]) < 0.6f ? 0 : 1;
  std::array<double, 3> t{};
  t[least] = 1;
  const auto along = static_cast<double>(n[least]);
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    t[i] -= along * static_cast<double>(n[i]);
    length += t[i] * t[i];
  }
  Three out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = static_cast<float>(std::cos(angle) * static_cast<double>(n[i]) +
                                std::sin(angle) * t[i] / std::sqrt(length));
  }
  return out;
}

/// Pixels of equal colour and features; k and the strengths are no round numbers.
inline Pair equal_pair(carlo::Rng& rng) {
  Pair pair;
  pair.one.color = drawn_three(rng, 0.5, 2);
  pair.one.variance = drawn_three(rng, 0.01, 0.04);
  pair.one.albedo = drawn_three(rng, 0.2, 0.7);
  pair.one.normal = drawn_normal(rng);
  pair.one.depth = static_cast<float>(3 + 4 * rng.uniform());
  pair.other = pair.one;
  pair.other.variance = drawn_three(rng, 0.05, 0.2);
  pair.strength = {1.3 + rng.uniform(), 0.07 + 0.05 * rng.uniform(), 0.12 + 0.06 * rng.uniform(),
                   0.06 + 0.04 * rng.uniform()};
  return pair;
}

/// Moves the other colour by this many standard errors of the difference, in each channel.
inline void part_colors(Pair& pair, double first, double second, double third) {
  const std::array<double, 3> errors{first, second, third};
  for (std::size_t c = 0; c < 3; ++c) {
    const double v =
        static_cast<double>(pair.one.variance[c]) + static_cast<double>(pair.other.variance[c]);
    pair.other.color[c] += static_cast<float>(errors[c] * std::sqrt(v));
  }
}

inline Pair drawn_pair(PairKind kind, carlo::Rng& rng) {
  Pair pair = equal_pair(rng);
  Pixel& other = pair.other;
  const bool all = kind == everything;
  if (kind == albedo || all) {
    for (float& x : other.albedo)
      x += static_cast<float>(pair.strength.albedo * (all ? 0.3 : 0.4 + 0.6 * rng.uniform()));
  }
  if (kind == normal || all)
    other.normal = turned_normal(pair.one.normal, pair.strength.normal * (all ? 0.5 : 1.4));
  if (kind == depth || all)
    other.depth *= static_cast<float>(1 + pair.strength.depth * (all ? 0.6 : 1.7));
  if (kind == sky || kind == no_depth) other.depth = 0;
  if (kind == no_depth) pair.one.depth = 0;
  if (kind == sky) pair.strength.depth = 0.5;  // the relative distance is 1
  if (kind == color) part_colors(pair, 3.1, -2.3, 0.4);
  if (all) part_colors(pair, 1.5, -0.3, -1.8);
  if (kind == noise) part_colors(pair, 0.6, -0.9, 0.3);
  if (kind == one_sure) {
    pair.one.variance = {};
    part_colors(pair, 2.2, 0.5, -2.7);
  }
  if (kind == both_sure || kind == same_sure) pair.one.variance = other.variance = {};
  if (kind == both_sure) other.color[2] += 1e-3f;
  return pair;
}

inline std::vector<Pair> drawn_pairs(std::uint64_t seed) {
  carlo::Rng rng(seed);
  std::vector<Pair> pairs;
  for (int kind = 0; kind < pair_kinds; ++kind)
    pairs.push_back(drawn_pair(static_cast<PairKind>(kind), rng));
  return pairs;
}

/// An image, row by row.
struct PixelImage {
  int width = 0, height = 0;
  std::vector<Pixel> pixels;
  Strength strength;

  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// How an image's pixels differ, apart from their colours and variances.
enum ImageKind {
  flat,   ///< not at all, and k is so large that colours do not matter
  edged,  ///< the edge of a wall: all features beyond it are far from those before
  rough   ///< a little in everything
};

inline PixelImage drawn_image(ImageKind kind, std::uint64_t seed) {
  carlo::Rng rng(seed);
  PixelImage image{9, 7, {}, {}};
  const Pair base = drawn_pair(nothing, rng);
  image.strength = base.strength;
  if (kind != rough) image.strength.color = 1e6;
  for (int i = 0; i < image.width * image.height; ++i) {
    Pixel pixel = base.one;
    pixel.color = drawn_three(rng, 0.5, 2);
    pixel.variance = drawn_three(rng, 0.1, 0.5);
    if (kind == edged && i % image.width >= 5) {
      pixel.normal = turned_normal(pixel.normal, 1.5);
      pixel.depth *= 3;
    }
    if (kind == rough) {
      for (float& x : pixel.albedo)
        x += static_cast<float>(image.strength.albedo * (rng.uniform() - 0.5));
      pixel.normal = turned_normal(pixel.normal, image.strength.normal * rng.uniform());
      pixel.depth *= static_cast<float>(1 + image.strength.depth * rng.uniform());
    }
    image.pixels.push_back(pixel);
  }
  return image;
}

}  // namespace lab09_features
