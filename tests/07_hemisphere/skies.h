#pragma once

#include "07_hemisphere/places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

// The images of Lab 7.8, and the test inputs; the convention is that of the contract.

namespace lab07_tests {

enum class Sky {
  one_texel = 0,  ///< a single texel: the whole sphere
  spotted = 1,    ///< no two texels alike, some black, a row of black ones
  half = 2,       ///< radiance 1 above the horizon y = 0, none below
  sun_top = 3,    ///< one texel alone, in the first row, beside the seam,
  sun_middle = 4,
  sun_bottom = 5,  ///< in the last row, at the other side of the seam
  cap = 6,         ///< the first of 4000 rows
  glare = 7        ///< 1 everywhere, and a sun of 1e9 in one texel
};

inline const char* name_of(Sky sky) {
  constexpr std::array<const char*, 8> names = {"one texel",
                                                "12 x 6 texels with black ones",
                                                "a sky over black ground",
                                                "a sun in the first row",
                                                "a sun in row 14 of 32",
                                                "a sun in the last row",
                                                "8 x 4000 texels, the first row alone bright",
                                                "a sky with a sun of 1e9 times its radiance"};
  return names[static_cast<std::size_t>(sky)];
}

struct SkyImage {
  std::size_t width, height;
  std::vector<double> luminance;
  double power =
      0;  ///< luminance times solid angle, over all texels: summed once, not for each place

  SkyImage(std::size_t columns, std::size_t rows, std::vector<double> texels)
      : width(columns), height(rows), luminance(std::move(texels)) {
    for (std::size_t k = 0; k < luminance.size(); ++k) {
      if (luminance[k] > 0) power += luminance[k] * solid_angle(k / width);
    }
  }

  double solid_angle(std::size_t row) const {
    // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2).
    const auto rows = static_cast<double>(height);
    return 4 * pi / static_cast<double>(width) *
           std::sin(pi * (static_cast<double>(row) + 0.5) / rows) * std::sin(pi / (2 * rows));
  }
};

/// A single texel of luminance 5e4.
inline SkyImage lone_sun(std::size_t column, std::size_t row) {
  constexpr std::size_t width = 64, height = 32;
  std::vector<double> texels(width * height);
  texels[row * width + column] = 5e4;
  return {width, height, texels};
}

inline SkyImage sky_image(Sky sky) {
  switch (sky) {
    case Sky::one_texel:
      break;
    case Sky::spotted: {
      constexpr std::size_t width = 12, height = 6;
      std::vector<double> texels;
      for (std::size_t k = 0; k < width * height; ++k) {
        const bool black = k / width == 3 || k * k % 7 == 1;
        texels.push_back(black ? 0 : 1 + static_cast<double>(k * k * 37 % 101) / 20);
      }
      return {width, height, texels};
    }
    case Sky::half:
      return {4, 2, {1, 1, 1, 1, 0, 0, 0, 0}};
    case Sky::sun_top:
      return lone_sun(0, 0);
    case Sky::sun_middle:
      return lone_sun(41, 13);
    case Sky::sun_bottom:
      return lone_sun(63, 31);
    case Sky::glare: {
      std::vector<double> texels(32, 1);
      texels[18] = 1e9;
      return {8, 4, texels};
    }
    case Sky::cap: {
      constexpr std::size_t width = 8, height = 4000;
      std::vector<double> texels(width * height);
      std::fill_n(texels.begin(), width, 1);
      return {width, height, texels};
    }
  }
  return {1, 1, {2.5}};
}

/// A u that selects a texel of an image.
struct TexelNumber {
  glm::dvec2 u;
  std::size_t texel;
};

/// Numbers well within the shares of rows, and of columns in the brightest row.
inline std::vector<TexelNumber> numbers_of_texels(const SkyImage& image) {
  std::vector<TexelNumber> numbers;
  const auto sun = static_cast<std::size_t>(
      std::max_element(image.luminance.begin(), image.luminance.end()) - image.luminance.begin());
  double before_row = 0, row_sum = 0;
  for (std::size_t j = 0; j < image.height; ++j) {
    const auto texel = [&](std::size_t i) { return j * image.width + i; };
    double luminance = 0;
    for (std::size_t i = 0; i < image.width; ++i)
      luminance += image.luminance[texel(i)];
    row_sum = luminance * image.solid_angle(j) / image.power;
    const double middle = before_row + row_sum / 2;
    double before = 0;
    for (std::size_t i = 0; i < image.width; ++i) {
      const double width = image.luminance[texel(i)] / luminance;
      if (j == sun / image.width || i % 3 == 0)
        numbers.push_back({{before + width / 2, middle}, texel(i)});
      before += width;
    }
    before_row += row_sum;
  }
  return numbers;
}

/// A point of the image, in [0, 1]^2.
struct ImagePoint {
  double x, y;
};

inline Double3 seen_in(ImagePoint p) {
  const double phi = 2 * pi * p.x, sine = std::sin(pi * p.y);
  return {sine * std::sin(phi), std::cos(pi * p.y), -sine * std::cos(phi)};
}

inline ImagePoint stands_at(Double3 w) {
  const double around = std::atan2(w.x, -w.z) / (2 * pi);
  return {around < 0 ? around + 1 : around, std::atan2(std::hypot(w.x, w.z), w.y) / pi};
}

/// All over the image, including edges and corners.
inline std::vector<ImagePoint> image_places() {
  std::vector<ImagePoint> places;
  for (int j = 0; j <= 32; ++j) {
    for (int i = 0; i <= 32; ++i)
      places.push_back({i / 32.0, j / 32.0});
  }
  for (int i = 1; i <= 40; ++i)
    places.push_back({i / 41.0, std::pow(10.0, -i / 8.0)});
  return places;
}

/// Floats all over the sphere, on the axes, and ever closer to both poles and to both sides of the
/// seam.
inline std::vector<Vec3> sphere_places() {
  std::vector<Vec3> places = {{0, 1, 0},       {0, -1, 0},       {1, 0, 0},       {-1, 0, 0},
                              {0, 0, 1},       {-0.0f, 0, 1},    {0, 0, -1},      {-0.0f, 0, -1},
                              {0, 1, -0.0f},   {-1e-30f, 0, -1}, {1e-30f, 0, -1}, {-1e-9f, 0, -1},
                              {-1e-20f, -1, 0}};
  for (int i = 4; i <= 56; ++i) {
    const double off = std::pow(10.0, -i / 8.0), turn = 2.399963229728653 * i;
    const Double3 beside_pole(std::sin(off) * std::cos(turn), std::cos(off),
                              std::sin(off) * std::sin(turn));
    places.emplace_back(beside_pole);
    places.emplace_back(beside_pole.x, -beside_pole.y, beside_pole.z);
    places.emplace_back(std::sin(off), 0, -std::cos(off));
    places.emplace_back(-std::sin(off) * 0.8, 0.6, -std::cos(off) * 0.8);
  }
  constexpr int spiral = 500;
  for (int i = 0; i < spiral; ++i) {
    const double z = 1 - (2 * i + 1.0) / spiral;
    places.push_back(at_angles(std::acos(z), 2.399963229728653 * i));
  }
  return places;
}

/// Places at which densities are tested: nine points within each texel, away from its edges, in the
/// rows given by `density_rows`; then both poles.
inline std::vector<std::size_t> density_rows(const SkyImage& image) {
  std::vector<std::size_t> rows;
  for (std::size_t j = 0; j < image.height; ++j) {
    if (j < 20 || j + 2 > image.height) rows.push_back(j);
  }
  return rows;
}
inline std::vector<Vec3> density_places(const SkyImage& image) {
  std::vector<Vec3> places;
  for (const std::size_t j : density_rows(image)) {
    for (std::size_t i = 0; i < image.width; ++i) {
      for (int k = 0; k < 9; ++k) {
        const int across = k % 3, down = k / 3;
        const double x = static_cast<double>(i) + 0.02 + 0.48 * across;
        const double y = static_cast<double>(j) + 0.02 + 0.48 * down;
        places.emplace_back(
            seen_in({x / static_cast<double>(image.width), y / static_cast<double>(image.height)}));
      }
    }
  }
  return places;
}

}  // namespace lab07_tests
