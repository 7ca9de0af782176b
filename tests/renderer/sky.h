#pragma once

#include "image/image.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace sky {

constexpr int width = 256, height = 128;
/// The sun's texel, 46 degrees above the horizon, and its radiance: it sends level ground three
/// times as much as the rest of the sky.
constexpr int sun_column = 96, sun_row = 31;
constexpr float sun = 13000;

/// Rounds values to 10 bits, which EXR packs well.
inline float rounded(double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return std::bit_cast<float>((bits + 0x1000) & ~0x1FFFu);
}

/// The direction in the middle of a texel (common/scene/envmap.h).
inline glm::dvec3 direction(int column, int row) {
  const double pi = 3.14159265358979323846;
  const double phi = 2 * pi * (column + .5) / width, theta = pi * (row + .5) / height;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

/// The radiance there: from white at the horizon to blue above, a glow around the sun, brown
/// ground.
inline glm::dvec3 radiance(glm::dvec3 d) {
  if (d.y < 0) return {.16, .13, .1};
  const double up = std::sqrt(d.y), away = 1 - glm::dot(d, direction(sun_column, sun_row));
  const glm::dvec3 clear = glm::mix(glm::dvec3(.75, .8, .85), glm::dvec3(.08, .2, .55), up);
  return clear + (.5 * std::exp(-12 * away) + 2 * std::exp(-200 * away)) * glm::dvec3(1, .85, .6);
}

/// The sky of common/scenes/image_light.xml.
inline carlo::Image image() {
  carlo::Image sky(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 L = radiance(direction(x, y));
      sky.at(x, y) = {rounded(L.r), rounded(L.g), rounded(L.b)};
    }
  }
  sky.at(sun_column, sun_row) = sun * carlo::Rgb(1, .9375f, .8125f);
  return sky;
}

}  // namespace sky
