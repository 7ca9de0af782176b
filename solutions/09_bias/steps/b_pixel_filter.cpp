#include "bias.h"
#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

// Lab 09, step b: pixel filters. Solved.

namespace lab09 {
namespace {

/// The fraction of the untruncated Gaussian within `radius` of its middle.
double kept(const PixelFilter& filter) {
  return std::erf(filter.radius / (filter.sigma * std::sqrt(2.0)));
}

double gaussian(double x, double sigma) {
  const double t = x / sigma;
  return std::exp(-t * t / 2) / (sigma * std::sqrt(2 * carlo::pi));
}

/// The curve along one axis: it integrates to 1.
double curve_value(const PixelFilter& filter, double x) {
  const double r = filter.radius, distance = std::abs(x);
  if (distance > r) return 0;
  switch (filter.curve) {
    case PixelFilter::Curve::box:
      return 1 / (2 * r);
    case PixelFilter::Curve::tent:
      return (1 - distance / r) / r;
    case PixelFilter::Curve::gaussian:
      return gaussian(x, filter.sigma) / kept(filter);
  }
  return 0;
}

/// The distance from the middle within which the fraction `share` of the truncated Gaussian lies.
/// The integral is concave, so Newton's steps from 0 never overshoot.
double gaussian_distance(const PixelFilter& filter, double share) {
  const double goal = share * kept(filter), sigma = filter.sigma;
  const double close = 1e-6 * std::min(filter.radius, sigma);
  double x = 0, step = 0;
  do {
    step = (goal - std::erf(x / (sigma * std::sqrt(2.0)))) / (2 * gaussian(x, sigma));
    x += step;
  } while (step > close);
  return std::min(x, filter.radius);
}

double sample_curve(const PixelFilter& filter, float u) {
  const double s = 2 * static_cast<double>(u) - 1, share = std::abs(s);
  double distance = share * filter.radius;
  if (filter.curve == PixelFilter::Curve::tent)
    distance = (1 - std::sqrt(1 - share)) * filter.radius;
  if (filter.curve == PixelFilter::Curve::gaussian) distance = gaussian_distance(filter, share);
  return std::copysign(distance, s);
}

/// The radiance through an offset from the pixel's middle.
Rgb radiance_at(const carlo::Camera& camera, int width, int height, int x, int y, Offset offset,
                const Radiance& radiance) {
  return radiance(camera.ray({(x + 0.5 + offset.x) / width, (y + 0.5 + offset.y) / height}));
}

}  // namespace

// Lab 9.2 -----------------------------------------------------------------------------------------

double filter_value(const PixelFilter& filter, double x, double y) {
  return curve_value(filter, x) * curve_value(filter, y);
}

Offset sample_filter(const PixelFilter& filter, Vec2 u) {
  return {sample_curve(filter, u.x), sample_curve(filter, u.y)};
}

Rgb filtered_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  glm::dvec3 sum(0);
  for (int i = 0; i < samples; ++i) {
    const float across = rng.uniform_float();
    const float down = rng.uniform_float();
    const Offset offset = sample_filter(filter, {across, down});
    sum += radiance_at(camera, width, height, x, y, offset, radiance);
  }
  return sum / static_cast<double>(samples);
}

Rgb weighted_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  glm::dvec3 sum(0);
  double weights = 0;
  for (int i = 0; i < samples; ++i) {
    const double across = 2 * rng.uniform() - 1, down = 2 * rng.uniform() - 1;
    const Offset offset{filter.radius * across, filter.radius * down};
    const double weight = filter_value(filter, offset.x, offset.y);
    sum += weight * glm::dvec3(radiance_at(camera, width, height, x, y, offset, radiance));
    weights += weight;
  }
  return weights == 0 ? Rgb(0) : Rgb(sum / weights);
}

}  // namespace lab09
