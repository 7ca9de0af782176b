#include "bias.h"

#include <algorithm>
#include <cmath>

// Lab 09, step c: a filter that knows edges. bias.h says what each function takes and returns.

namespace lab09 {
namespace {

/// |a - b|^2
double apart2(glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 apart = a - b;
  return glm::dot(apart, apart);
}

/// The mean over the channels; infinity where colours that are known exactly differ.
double color_distance(const FeaturePixel& one, const FeaturePixel& other, double k) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double apart = static_cast<double>(one.color[c]) - static_cast<double>(other.color[c]);
    const double v = static_cast<double>(one.variance[c]) + static_cast<double>(other.variance[c]);
    if (v == 0) {
      if (apart != 0) return INFINITY;
      continue;
    }
    sum += std::max(0.0, apart * apart - v) / (k * k * v);
  }
  return sum / 3;
}

}  // namespace

// Lab 9.3 -----------------------------------------------------------------------------------------

double feature_weight(const FeaturePixel& one, const FeaturePixel& other,
                      const FilterStrength& strength) {
  double d = apart2(one.albedo, other.albedo) / (2 * strength.albedo * strength.albedo) +
             apart2(one.normal, other.normal) / (2 * strength.normal * strength.normal);
  const auto larger = static_cast<double>(std::max(one.depth, other.depth));
  if (larger > 0) {
    const double part =
        (static_cast<double>(one.depth) - static_cast<double>(other.depth)) / larger;
    d += part * part / (2 * strength.depth * strength.depth);
  }
  return std::exp(-d - color_distance(one, other, strength.color));
}

Filtered filter_pixel(const FeatureImage& image, int x, int y, const FilterStrength& strength) {
  const FeaturePixel& middle = image.at(x, y);
  const int last_x = std::min(x + strength.radius, image.width() - 1);
  const int last_y = std::min(y + strength.radius, image.height() - 1);
  double weights = 0;  // at least the pixel's own: 1
  glm::dvec3 color(0), variance(0);
  for (int other_y = std::max(y - strength.radius, 0); other_y <= last_y; ++other_y) {
    for (int other_x = std::max(x - strength.radius, 0); other_x <= last_x; ++other_x) {
      const FeaturePixel& other = image.at(other_x, other_y);
      const double w = feature_weight(middle, other, strength);
      weights += w;
      color += w * glm::dvec3(other.color);
      variance += w * w * glm::dvec3(other.variance);
    }
  }
  return {Rgb(color / weights), Rgb(variance / (weights * weights))};
}

}  // namespace lab09
