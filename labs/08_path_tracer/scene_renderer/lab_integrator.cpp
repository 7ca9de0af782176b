#include "scene_renderer/lab_integrator.h"

#include "given/sampled.h"
#include "given/world.h"
#include "path_tracer.h"
#include "random/hash.h"
#include "scene/match.h"
#include "scene/needs.h"
#include "scene/sampler_kind.h"
#include "support/error.h"

#include <algorithm>
#include <string>

namespace lab08 {
namespace {

using carlo::Scene;

bool specular(const carlo::Material& material) {
  return carlo::match(
      material.model, [](const carlo::Diffuse&) { return false; },
      [](const carlo::Phong&) { return false; }, [](const carlo::Mirror&) { return true; },
      [](const carlo::Dielectric&) { return true; });
}

/// Refuses scenes that the method would render wrongly.
const Scene& checked(const Scene& scene, Method method) {
  if (method == Method::iterative) return scene;
  if (scene.max_depth != 0) {
    throw carlo::Error(
        "the recursive tracers follow paths of any length, the scene's end after {} segments: give "
        "--max-depth 0, or no --method",
        scene.max_depth);
  }
  const auto shows_specular = [&](const carlo::Shape& shape) {
    return specular(scene.materials[shape.material]);
  };
  if (method == Method::recursive &&
      std::any_of(scene.shapes.begin(), scene.shapes.end(), shows_specular)) {
    throw carlo::Error("Lab 8.4 does not support mirrors or glass: use --method direct");
  }
  return scene;
}

template <class Sampler>
class LabIntegrator final : public carlo::Integrator {
 public:
  LabIntegrator(const Scene& scene, const LabIntegratorOptions& options)
      : world_(checked(scene, options.method)), options_(options) {}

  std::string name() const override {
    const bool flat = carlo::needs(world_.scene()).vertex_normals;
    return tracer() + (flat ? ", without vertex normals" : "");
  }

  std::string tracer() const {
    switch (options_.method) {
      case Method::iterative:
        return "path_radiance of Lab 8.8";
      case Method::recursive:
        return "trace_path of Lab 8.4";
      case Method::direct:
        return "trace_specular of Lab 8.7";
    }
    return "";
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    const std::uint64_t seed = carlo::stream_seed(options_.seed, tile.stream);
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        carlo::BlockSum sum;
        for (std::uint32_t s = 0; s < tile.samples && !carlo::render_interrupted(); ++s)
          sum.add(sample(x, y, seed, tile.first_sample + s), counts);
        counts.paths += tile.samples;
        means[i++] = sum.mean(tile.samples);
      }
    }
  }

 private:
  Rgb sample(int x, int y, std::uint64_t seed, std::uint32_t index) const {
    const Scene& scene = world_.scene();
    const auto pixel = static_cast<std::uint32_t>(y * scene.width + x);
    Sampled<Sampler> numbers({seed, pixel, index, options_.spp});
    const Vec2 jitter = numbers.next_2d();
    const Ray ray =
        scene.camera.ray({(static_cast<float>(x) + jitter.x) / static_cast<float>(scene.width),
                          (static_cast<float>(y) + jitter.y) / static_cast<float>(scene.height)});
    if (options_.method == Method::iterative) {
      return path_radiance(world_, ray, scene.max_depth, numbers);
    }
    Rng rng(carlo::hash(seed, pixel), index);
    return options_.method == Method::recursive ? trace_path(world_, ray, rng)
                                                : trace_specular(world_, ray, true, rng);
  }

  World world_;
  LabIntegratorOptions options_;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lab_integrator(const Scene& scene,
                                                       const LabIntegratorOptions& options) {
  switch (scene.sampler) {
    case carlo::SamplerKind::independent:
      return std::make_unique<LabIntegrator<carlo::IndependentSampler>>(scene, options);
    case carlo::SamplerKind::stratified:
      return std::make_unique<LabIntegrator<carlo::StratifiedSampler>>(scene, options);
    case carlo::SamplerKind::sobol:
      return std::make_unique<LabIntegrator<carlo::SobolSampler>>(scene, options);
  }
  throw carlo::Error("lab 8 does not know the sampler {}", carlo::name_of(scene.sampler));
}

}  // namespace lab08
