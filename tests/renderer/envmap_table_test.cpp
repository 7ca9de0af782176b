// Directions drawn from an environment map: the density integrates to 1 and matches the
// directions, at the poles, in black images with a sun of one texel, and in rotated images.

#include "renderer/envmap_table.h"

#include "closed_forms.h"
#include "random/rng.h"
#include "stats/goodness.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace {

using carlo::Envmap;
using carlo::Image;
using renderer::EnvmapTable;

/// A rotation about an axis that is none of the image's.
glm::dmat3 some_turn() {
  const glm::dvec3 x = glm::normalize(glm::dvec3(2, 1, -3)),
                   y = glm::normalize(glm::cross(x, glm::dvec3(1, 5, 2)));
  return {x, y, glm::cross(x, y)};
}

Envmap image_of(int width, int height, carlo::Rgb colour = carlo::Rgb(0)) {
  Envmap map{Image(width, height), some_turn()};
  for (carlo::Rgb& texel : map.image.pixels)
    texel = colour;
  return map;
}

/// A varied image: black texels and a black row, rows and texels that are a thousand times as
/// bright.
Envmap assorted_image(int width, int height) {
  Envmap map = image_of(width, height);
  carlo::Rng rng(11);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float bright = std::exp(3 * rng.uniform_float());
      const bool black = rng.uniform_float() < .3f || y == 2;
      map.image.at(x, y) = black ? carlo::Rgb(0) : bright * carlo::Rgb(.2f, .5f, .9f);
    }
  }
  map.image.at(1, 1) = carlo::Rgb(1000);
  return map;
}

double solid_angle(const Envmap& map, int y) {
  const double step = closed_forms::pi / map.image.height;
  return 2 * closed_forms::pi / map.image.width * (std::cos(step * y) - std::cos(step * (y + 1)));
}

/// The quarter of its texel that a direction lies in, in halves of its azimuth and of its cosine: 0
/// to 3.
std::size_t quarter(const Envmap& map, carlo::Vec3 d) {
  const glm::dvec3 v = glm::transpose(map.rotation) * glm::dvec3(d);
  const double around = std::atan2(v.x, -v.z) / (2 * closed_forms::pi) + 1;
  const double column = around * map.image.width;
  const double step = closed_forms::pi / map.image.height;
  const double row = std::floor(std::acos(v.y) / step);
  const double top = std::cos(row * step), bottom = std::cos((row + 1) * step);
  const std::size_t below = (top - v.y) / (top - bottom) < .5 ? 0 : 2;
  return below + (column - std::floor(column) < .5 ? 0 : 1);
}

carlo::Vec2 draw_point(carlo::Rng& rng) {
  const float x = rng.uniform_float();
  const float y = rng.uniform_float();
  return {x, y};
}

TEST_CASE("An image's directions stand where Mitsuba's convention has them") {
  Envmap map{Image(8, 4)};
  const auto texel = [&](carlo::Vec3 d) { return texel_at(map, glm::normalize(d)); };
  // The middles of texels: -z is the left edge, +x a quarter of the width to the right.
  const float a = .3f;
  CHECK(texel({a, .1f, -1}) == map.image.index(0, 1));
  CHECK(texel({1, .1f, a}) == map.image.index(2, 1));
  CHECK(texel({-a, .1f, 1}) == map.image.index(4, 1));
  CHECK(texel({-1, .1f, -a}) == map.image.index(6, 1));
  CHECK(texel({-a, -.1f, -1}) == map.image.index(7, 2));
  CHECK(texel({.01f, 1, -.001f}) == map.image.index(1, 0));
  CHECK(texel({0, 1, 0}) < 8);
  CHECK(texel({0, -1, 0}) >= 24);
  // An image rotated about the vertical by a quarter has its left edge elsewhere.
  map.rotation = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);
  CHECK(texel({-1, .1f, -a}) == map.image.index(0, 1));
}

TEST_CASE("The density of an image's directions integrates to 1") {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {3, 5}, {16, 8}, {512, 256}}) {
    const Envmap map =
        width < 3 ? image_of(width, height, carlo::Rgb(.1f, 2, 3)) : assorted_image(width, height);
    const EnvmapTable table(map);
    double integral = 0, brightness = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto& [r, g, b, pdf] = table.texels[map.image.index(x, y)];
        integral += static_cast<double>(pdf) * solid_angle(map, y);
        brightness += static_cast<double>(r + g + b) * solid_angle(map, y);
      }
    }
    INFO(width << " x " << height);
    CHECK(std::abs(integral - 1) <= 1e-6);
    CHECK(std::abs(table.brightness / brightness - 1) <= 1e-6);
  }
}

// Chi-square over the quarters of all texels, one alpha of 1e-4 for each of two images: another
// seed would fail with probability 2e-4. Power: with 2e6 points a texel's quarter of average
// probability has 5000; a third of one row that is wrong (a forgotten sin(theta) moves more) adds
// over 1000 to a statistic of standard deviation 30.
TEST_CASE("Directions come with the density that is told") {
  for (const auto& [width, height] : {std::pair{12, 7}, {16, 8}}) {
    const Envmap map = assorted_image(width, height);
    const EnvmapTable table(map);
    const std::size_t texels = map.image.pixels.size();
    std::vector<double> counts(4 * texels);
    carlo::Rng rng(3);
    constexpr int n = 2'000'000;
    int elsewhere = 0;
    for (int i = 0; i < n; ++i) {
      const EnvmapTable::Sample s = table.sample(draw_point(rng));
      const EnvmapTable::Texel seen = table.at(s.wi);
      if (!(s.pdf > 0) || s.radiance == carlo::Rgb(0)) FAIL("drawn from a black texel");
      if (std::abs(glm::length(s.wi) - 1) > 1e-6f) FAIL("no direction");
      // At a texel's edge rounding may move a direction into the next texel.
      elsewhere += seen.pdf != s.pdf || seen.radiance != s.radiance ? 1 : 0;
      ++counts[4 * texel_at(map, s.wi) + quarter(map, s.wi)];
    }
    CHECK(elsewhere <= 20);
    std::vector<double> found, expected;
    for (std::size_t i = 0; i < 4 * texels; ++i) {
      const auto y = static_cast<int>(i / 4) / width;
      const double chance = static_cast<double>(table.texels[i / 4][3]) * solid_angle(map, y) / 4;
      if (chance == 0) {
        CHECK(counts[i] <= 5);  // across the edge
        continue;
      }
      found.push_back(counts[i]);
      expected.push_back(n * chance);
    }
    const carlo::Goodness g = carlo::pooled_goodness(found, expected);
    INFO(width << " x " << height << ": chi-square " << g.statistic << " of " << g.freedom);
    CHECK(g.p > 1e-4);
  }
}

TEST_CASE("Chances are whole multiples of the step between random numbers") {
  const Envmap map = assorted_image(200, 100);
  const EnvmapTable table(map);
  for (const std::vector<float>& sums : {table.rows, table.columns}) {
    for (const float sum : sums)
      CHECK(sum * 0x1p24f == std::round(sum * 0x1p24f));
  }
}

TEST_CASE("A uniform image has the density 1 / (4 pi) everywhere, at the poles too") {
  for (const int height : {1, 2, 7, 64, 2048}) {
    const Envmap map = image_of(2 * height, height, carlo::Rgb(5));
    const EnvmapTable table(map);
    carlo::Rng rng(4);
    for (int i = 0; i < 2000; ++i) {
      // Every other direction close to a pole: the first row, and the last.
      carlo::Vec2 u = draw_point(rng);
      if (i % 2 == 0) u.y = i % 4 == 0 ? 1e-7f * u.y : 1 - 1e-7f * u.y;
      u.y = std::min(u.y, 0x1.fffffep-1f);
      const EnvmapTable::Sample s = table.sample(u);
      // Half a step of 2^-24 of a row's probability, which is pi^2 / (4 h^2) at the poles, and of a
      // texel's in its row, which is 1 / (2 h).
      const double allowed = 1e-6 + 0x1p-24 * (.25 * height * height + 2 * height);
      CHECK(std::abs(static_cast<double>(s.pdf) * 4 * closed_forms::pi - 1) <= allowed);
      CHECK(s.radiance == carlo::Rgb(5));
    }
  }
}

TEST_CASE("The corners of the unit square are directions as others are") {
  constexpr float last = 0x1.fffffep-1f;
  const Envmap map = assorted_image(16, 8);
  const EnvmapTable table(map);
  for (const float x : {0.0f, 0x1p-24f, .5f, last}) {
    for (const float y : {0.0f, 0x1p-24f, .5f, last}) {
      const EnvmapTable::Sample s = table.sample({x, y});
      CHECK(s.pdf > 0);
      CHECK(std::abs(glm::length(s.wi) - 1) <= 1e-6f);
      CHECK(s.radiance != carlo::Rgb(0));
    }
  }
}

TEST_CASE("Of a black image with a sun of one texel all directions are the sun's") {
  for (const int row : {0, 20, 63}) {
    Envmap map = image_of(128, 64);
    const std::size_t sun = map.image.index(77, row);
    map.image.pixels[sun] = carlo::Rgb(1e5f, 9e4f, 8e4f);
    const EnvmapTable table(map);
    const double per = 1 / solid_angle(map, row);
    carlo::Rng rng(5);
    int elsewhere = 0;
    for (int i = 0; i < 20000; ++i) {
      const EnvmapTable::Sample s = table.sample(draw_point(rng));
      elsewhere += texel_at(map, s.wi) == sun ? 0 : 1;
      CHECK(s.radiance == map.image.pixels[sun]);
      CHECK(std::abs(static_cast<double>(s.pdf) / per - 1) <= 1e-5);
    }
    CHECK(elsewhere <= 20);
  }
}

}  // namespace
