#include "render/error_map.h"

#include "render/colour_scale.h"

#include <cmath>

namespace carlo {
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

}  // namespace carlo
