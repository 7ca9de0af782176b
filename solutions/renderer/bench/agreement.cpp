#include "agreement.h"

#include "image/metrics.h"
#include "support/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench {
namespace {

using carlo::Image;
using carlo::Rgb;

Image mean_of(const std::vector<Image>& images) {
  Image mean(images.front().width, images.front().height);
  for (const Image& image : images) {
    if (image.width != mean.width || image.height != mean.height) {
      throw carlo::Error("images of one scene differ in size");
    }
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
      mean.pixels[i] += image.pixels[i] / static_cast<float>(images.size());
  }
  return mean;
}

/// The standard error of the mean, from the spread of each pixel.
Image standard_error(const std::vector<Image>& images, const Image& mean) {
  const auto n = static_cast<float>(images.size());
  Image error(mean.width, mean.height);
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    Rgb squares(0);
    for (const Image& image : images) {
      const Rgb d = image.pixels[i] - mean.pixels[i];
      squares += d * d;
    }
    error.pixels[i] = glm::sqrt(squares / (n * (n - 1)));
  }
  return error;
}

/// The larger one; infinite if one is NaN, which std::max would ignore.
double farther(double a, double b) {
  return std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, std::abs(b));
}

}  // namespace

bool Agreement::holds() const {
  return tile_z <= agreement_limit && mean_z <= agreement_limit;
}

Agreement agreement(const std::vector<Image>& images, const Image& reference,
                    const Image& reference_error) {
  if (images.size() < 2) throw carlo::Error("one image has no spread; two are needed");
  const Image mean = mean_of(images);
  const Image error = standard_error(images, mean);
  Agreement result;
  for (const double z : carlo::tile_z(mean, error, reference, reference_error, agreement_tile))
    result.tile_z = farther(result.tile_z, z);
  for (const double z : carlo::bias_z(mean, error, reference, reference_error))
    result.mean_z = farther(result.mean_z, z);
  const carlo::ImageError means = carlo::compare(mean, reference);
  result.mean_ratio = (means.mean[0] + means.mean[1] + means.mean[2]) /
                      (means.reference[0] + means.reference[1] + means.reference[2]);
  return result;
}

double rel_mse_noise(const Image& reference, const Image& reference_error) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double r = reference.pixels[i][c], e = reference_error.pixels.at(i)[c];
      sum += e * e / (r * r + .01);
    }
  }
  return sum / (3 * static_cast<double>(reference.pixels.size()));
}

Rung at_error(const Rung& fewer, const Rung& more, double rel_mse) {
  const auto scaled = [&](const Rung& rung) {
    const double factor = rung.rel_mse / rel_mse;
    return Rung{rung.samples * factor, rung.seconds * factor, rel_mse};
  };
  if (rel_mse >= fewer.rel_mse) return scaled(fewer);
  if (rel_mse <= more.rel_mse) return scaled(more);
  const double t = std::log(fewer.rel_mse / rel_mse) / std::log(fewer.rel_mse / more.rel_mse);
  const auto between = [t](double a, double b) { return a * std::pow(b / a, t); };
  return {between(fewer.samples, more.samples), between(fewer.seconds, more.seconds), rel_mse};
}

}  // namespace bench
