#include "render/samples_map.h"

#include "render/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carlo {

Image samples_map(const Film& film) {
  std::uint64_t least = film.samples(0, 0), most = least;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      least = std::min(least, film.samples(x, y));
      most = std::max(most, film.samples(x, y));
    }
  }
  // An interrupted render has pixels without a sample; they share the darkest colour with those
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
