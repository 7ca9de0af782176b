#include "course/render/pixel_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace carlo {
namespace {

constexpr std::array<std::array<float, 3>, 5> anchors = {{{0.005f, 0.005f, 0.04f},
                                                          {0.03f, 0.05f, 0.25f},
                                                          {0.25f, 0.05f, 0.25f},
                                                          {0.80f, 0.20f, 0.05f},
                                                          {1.00f, 0.85f, 0.30f}}};

/// Maps a value between 0 and 1 to a colour from dark blue to yellow, linear RGB. The brightness
/// rises along the map, so that it can be read in grey and by colour-blind eyes. Values outside are
/// clamped.
Rgb scale_colour(double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (anchors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), anchors.size() - 2);
  const auto f = static_cast<float>(x - static_cast<double>(i));
  Rgb c;
  for (int k = 0; k < 3; ++k) {
    const auto channel = static_cast<std::size_t>(k);
    c[k] = (1 - f) * anchors[i][channel] + f * anchors[i + 1][channel];
  }
  return c;
}

}  // namespace

Image error_map(const Film& film) {
  Image map(film.width(), film.height());
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      double mean = 0, variance = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        mean += film.mean(x, y, c);
        variance += film.variance(x, y, c);
      }
      if (!std::isfinite(variance)) {
        map.at(x, y) = Rgb(0.2f);
        continue;
      }
      const double relative = mean > 0 ? std::sqrt(3 * variance) / mean : 0;
      map.at(x, y) = relative > 0 ? scale_colour((std::log10(relative) + 3) / 3) : scale_colour(0);
    }
  }
  return map;
}

Image samples_map(const Film& film) {
  std::uint64_t least = film.samples(0, 0), most = least;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      least = std::min(least, film.samples(x, y));
      most = std::max(most, film.samples(x, y));
    }
  }
  // An interrupted render has pixels without a sample; they share the darkest colour with pixels
  // that have one.
  const auto log_of = [](std::uint64_t n) {
    return std::log2(static_cast<double>(std::max<std::uint64_t>(n, 1)));
  };
  const double low = log_of(least), range = log_of(most) - low;
  Image map(film.width(), film.height());
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      map.at(x, y) = scale_colour(range > 0 ? (log_of(film.samples(x, y)) - low) / range : 0.5);
  }
  return map;
}

}  // namespace carlo
