#include "photon_run.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace lab09 {

static void trace_photons(const World& world, std::int64_t emitted, Kept kept, Rng& rng,
                          std::vector<Photon>& stored) {
  for (std::int64_t n = 0; n < emitted; ++n) {
    trace_photon(world, emit_photon(world, rng), rng, [&](const Photon& photon) {
      if (kept == Kept::all || photon.caustic()) stored.push_back(photon);
    });
  }
}

PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, Rng& rng) {
  std::vector<Photon> photons;
  trace_photons(world, emitted, kept, rng, photons);
  return {std::move(photons), 1 / static_cast<float>(emitted)};
}

PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, std::uint64_t seed) {
  constexpr std::int64_t block = 4096;  // photons per stream of random numbers
  const auto blocks = static_cast<std::size_t>((emitted + block - 1) / block);
  std::vector<std::vector<Photon>> stored(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    Rng rng(seed, i);
    const std::int64_t count = std::min(block, emitted - static_cast<std::int64_t>(i) * block);
    trace_photons(world, count, kept, rng, stored[i]);
  });
  std::vector<Photon> all;
  for (const std::vector<Photon>& some : stored)
    all.insert(all.end(), some.begin(), some.end());
  return {std::move(all), 1 / static_cast<float>(emitted)};
}

carlo::Scene ball_of_glass() {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{{0.7f, 0.65f, 0.55f}}, false},
                     {carlo::Dielectric{1.5f, 1}, false},
                     {carlo::Diffuse{Rgb(0)}, false}};
  const Vec3 light(-1.6f, 1, 1.8f), ball(0, 0, 0.5f);
  scene.shapes = {{carlo::Parallelogram{{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}}, 0, Rgb(0)},
                  {carlo::Sphere{ball, 0.45f}, 1, Rgb(0)},
                  {carlo::Disk{light, glm::normalize(ball - light), 0.25f}, 2, Rgb(14)}};
  carlo::Camera& camera = scene.camera;
  camera.origin = {1.2f, -3.4f, 2.1f};
  camera.forward = glm::normalize(Vec3(0.35f, -0.15f, 0.25f) - camera.origin);
  camera.right = glm::normalize(glm::cross(camera.forward, Vec3(0, 0, 1)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_half_fov = 0.3f;
  return scene;
}

lab08::SampledPixel on_floor(const lab08::View& view, lab08::SampledPixel pixel) {
  return [&view, pixel = std::move(pixel)](int x, int y, int samples, Rng& rng) {
    const auto surface = view.world.intersect(view.ray(x, y));
    const bool floor = surface && std::holds_alternative<carlo::Phong>(*surface->material);
    return floor ? pixel(x, y, samples, rng) : Rgb(0);
  };
}

ErrorParts image_error(std::span<const carlo::Image> renders, const lab08::Reference& reference) {
  const std::size_t pixels = reference.image.pixels.size();
  ErrorParts mean;
  std::vector<double> estimates(renders.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (int channel = 0; channel < 3; ++channel) {
      for (std::size_t i = 0; i < renders.size(); ++i)
        estimates[i] = static_cast<double>(renders[i].pixels[pixel][channel]);
      const ErrorParts parts =
          split_error(estimates, static_cast<double>(reference.image.pixels[pixel][channel]));
      mean.bias2 += parts.bias2;
      mean.variance += parts.variance;
    }
  }
  const double unit = lab08::mean_value(reference.image) * lab08::mean_value(reference.image);
  const double count = 3 * static_cast<double>(pixels);
  return {(mean.bias2 / count - reference.variance) / unit, mean.variance / count / unit};
}

}  // namespace lab09
