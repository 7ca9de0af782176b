#include "image/flip.h"

#include "random/rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace carlo;

Image constant(int width, int height, Rgb colour) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), colour);
  return image;
}

Image noise(std::uint64_t seed) {
  Image image(33, 21);
  Rng rng(seed);
  for (Rgb& pixel : image.pixels) {
    const double r = rng.uniform(), g = rng.uniform(), b = rng.uniform();
    pixel = Rgb(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b));
  }
  return image;
}

float greatest(const std::vector<float>& map) {
  return *std::max_element(map.begin(), map.end());
}

TEST_CASE("FLIP of an image with itself is zero") {
  const Image image = noise(1);
  for (const float value : flip_map(image, image))
    CHECK(value == 0);
}

TEST_CASE("FLIP of two constant images is their colour difference alone") {
  // Green against blue defines the end of the scale. Black and white differ by L* = 100 and nothing
  // else; the distance of green and blue, computed by hand from CIELAB of the primaries (L* 87.735,
  // 32.298; a* -86.183, 79.188; b* 83.179, -107.857, times L*/100): 55.437 + hypot(101.188,
  // 107.813) = 203.30.
  const Image black = constant(24, 16, Rgb(0)), white = constant(24, 16, Rgb(1));
  const Image green = constant(24, 16, Rgb(0, 1, 0)), blue = constant(24, 16, Rgb(0, 0, 1));
  for (const float value : flip_map(green, blue))
    CHECK(std::fabs(value - 1) <= 1e-5);
  const double most = std::pow(203.30, 0.7), black_white = std::pow(100.0, 0.7);
  const double expected = 0.95 + (black_white - 0.4 * most) / (0.6 * most) * 0.05;
  for (const float value : flip_map(black, white))
    CHECK(std::fabs(value - expected) <= 1e-4);
  // A small difference lies on the linear piece: L* of 0.2 and of 0.21, both greys.
  const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
  const double small = std::pow(lightness(0.21) - lightness(0.2), 0.7) * 0.95 / (0.4 * most);
  for (const float value : flip_map(constant(24, 16, Rgb(0.21f)), constant(24, 16, Rgb(0.2f))))
    CHECK(std::fabs(value - small) <= 2e-4);
}

TEST_CASE("FLIP is symmetric, lies in [0, 1], and is the mirrored images' mirrored map") {
  const Image a = noise(2), b = noise(3);
  const auto mirrored = [](Image image) {
    for (int y = 0; y < image.height; ++y)
      std::reverse(&image.at(0, y), &image.at(0, y) + image.width);
    return image;
  };
  const auto forward = flip_map(a, b), backward = flip_map(b, a);
  const auto mirror = flip_map(mirrored(a), mirrored(b));
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const float value = forward[a.index(x, y)];
      CHECK((value >= 0 && value <= 1));
      CHECK(std::fabs(value - backward[a.index(x, y)]) <= 1e-6);
      CHECK(std::fabs(value - mirror[a.index(a.width - 1 - x, y)]) <= 1e-5);
    }
  }
}

TEST_CASE("FLIP sees less of fine noise than of a coarse difference of the same size") {
  const Image grey = constant(64, 64, Rgb(0.5f));
  Image fine = grey, coarse = grey;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      fine.at(x, y) += Rgb((x + y) % 2 == 0 ? 0.1f : -0.1f);
      coarse.at(x, y) += Rgb(x < 32 ? 0.1f : -0.1f);
    }
  }
  CHECK(mean_flip(flip_map(fine, grey)) < 0.5 * mean_flip(flip_map(coarse, grey)));
}

TEST_CASE("FLIP finds one bright pixel near where it is, and nowhere else") {
  const Image grey = constant(96, 64, Rgb(0.2f));
  Image firefly = grey;
  firefly.at(48, 32) = Rgb(1);
  const auto map = flip_map(firefly, grey);
  CHECK(map[grey.index(48, 32)] > 0.2f);
  CHECK(map[grey.index(48, 32)] == greatest(map));
  CHECK(map[grey.index(48 + 25, 32)] < 1e-3f);
  CHECK(map[grey.index(48, 32 - 25)] < 1e-3f);
}

TEST_CASE("FLIP clips like a screen, takes NaN as black and refuses other sizes") {
  Image bright = constant(8, 8, Rgb(7)), broken = constant(8, 8, Rgb(std::nanf("")));
  CHECK(greatest(flip_map(bright, constant(8, 8, Rgb(1)))) == 0);
  CHECK(greatest(flip_map(broken, constant(8, 8, Rgb(0)))) == 0);
  CHECK_THROWS_AS(flip_map(bright, Image(8, 9)), Error);
}

}  // namespace
