#include "image/metrics.h"

#include "numeric/compensated.h"
#include "support/error.h"

#include <algorithm>
#include <cmath>

namespace carlo {
namespace {

void require_same_size(const Image& a, const Image& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw Error("the images differ in size: {} x {} against {} x {}", a.width, a.height, b.width,
              b.height);
}

/// z of the difference of means over the rectangle [x0, x1) x [y0, y1); `extra_variance`: the part
/// of the sum's variance that is due to correlation between pixels.
double rectangle_z(const Image& image, const Image& error, const Image& reference,
                   const Image& reference_error, int x0, int y0, int x1, int y1, int c,
                   double extra_variance = 0) {
  CompensatedSum difference, variance;
  variance.add(extra_variance);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      difference.add(static_cast<double>(image.at(x, y)[c]) - reference.at(x, y)[c]);
      const double a = error.at(x, y)[c], b = reference_error.at(x, y)[c];
      variance.add(a * a + b * b);
    }
  }
  const double d = difference.value();
  return d == 0 ? 0 : d / std::sqrt(variance.value());
}

}  // namespace

ImageError compare(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  ImageError result;
  CompensatedSum mse, rel_mse;
  std::array<CompensatedSum, 3> mean, reference_mean;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double a = image.pixels[i][c], r = reference.pixels[i][c];
      mse.add((a - r) * (a - r));
      rel_mse.add((a - r) * (a - r) / (r * r + 0.01));
      mean[static_cast<std::size_t>(c)].add(a);
      reference_mean[static_cast<std::size_t>(c)].add(r);
    }
  }
  const auto count = static_cast<double>(image.pixels.size());
  result.mse = mse.value() / (3 * count);
  result.rel_mse = rel_mse.value() / (3 * count);
  for (std::size_t c = 0; c < 3; ++c) {
    result.mean[c] = mean[c].value() / count;
    result.reference[c] = reference_mean[c].value() / count;
  }
  return result;
}

std::array<double, 3> bias_z(const Image& image, const Image& standard_error,
                             const Image& reference, const Image& reference_error,
                             const std::array<double, 3>& extra_variance) {
  require_same_size(image, reference);
  std::array<double, 3> z{};
  const double pixels = static_cast<double>(image.pixels.size());
  for (std::size_t c = 0; c < 3; ++c) {
    z[c] = rectangle_z(image, standard_error, reference, reference_error, 0, 0, image.width,
                       image.height, static_cast<int>(c), extra_variance[c] * pixels * pixels);
  }
  return z;
}

std::vector<double> tile_z(const Image& image, const Image& standard_error, const Image& reference,
                           const Image& reference_error, int tile) {
  require_same_size(image, reference);
  std::vector<double> z;
  for (int y = 0; y < image.height; y += tile) {
    for (int x = 0; x < image.width; x += tile) {
      for (int c = 0; c < 3; ++c) {
        z.push_back(rectangle_z(image, standard_error, reference, reference_error, x, y,
                                std::min(x + tile, image.width), std::min(y + tile, image.height),
                                c));
      }
    }
  }
  return z;
}

std::size_t count_non_finite(const Image& image) {
  return static_cast<std::size_t>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](const Rgb& p) {
        return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      }));
}

}  // namespace carlo
