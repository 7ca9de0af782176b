#include "given/sampled.h"
#include "practice.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace lab09 {
namespace {

/// Adds the features that the camera sees along one ray; `share`: one over the number of rays.
void add_features(const World& world, const Ray& ray, float share, FeaturePixel& pixel) {
  const auto met = world.intersect(ray);
  if (!met) return;
  const auto* phong = std::get_if<carlo::Phong>(met->material);
  pixel.albedo += share * (phong ? phong->kd + phong->ks : Rgb(1));
  pixel.normal += share * met->n;
  pixel.depth += share * glm::length(met->p - ray.o);
}

FeaturePixel noisy_pixel(const PracticeScene& s, int x, int y, std::uint64_t seed, int samples) {
  const auto number = static_cast<std::uint32_t>(y * s.reference.width + x);
  const int seen = std::min(samples, 16);  // features need fewer rays than light
  FeaturePixel pixel;
  glm::dvec3 sum(0), squares(0);
  for (int i = 0; i < samples; ++i) {
    lab08::Sampled<carlo::IndependentSampler> numbers(
        {seed, number, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(samples)});
    const Vec2 jitter = numbers.next_2d();
    const Ray ray = s.ray(x, y, jitter);
    const glm::dvec3 L = lab08::path_radiance(s.world, ray, 0, numbers);
    sum += L;
    squares += L * L;
    if (i < seen) add_features(s.world, ray, 1 / static_cast<float>(seen), pixel);
  }
  const double n = samples;
  pixel.color = sum / n;
  pixel.variance = glm::max(squares / n - sum * sum / (n * n), glm::dvec3(0)) / (n - 1);
  return pixel;
}

}  // namespace

FeatureImage noisy_image(const PracticeScene& scene, int samples, std::uint64_t seed) {
  FeatureImage image(scene.reference.width, scene.reference.height);
  tbb::parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x)
      image.at(x, y) = noisy_pixel(scene, x, y, seed, samples);
  });
  return image;
}

carlo::Image filtered_image(const FeatureImage& noisy, const FilterStrength& strength) {
  carlo::Image image(noisy.width(), noisy.height());
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = filter_pixel(noisy, x, y, strength).color;
  });
  return image;
}

}  // namespace lab09
