#include "renderer/flat/flat_integrator.h"

#include "renderer/flat/flat_kernel.h"

#include <fmt/core.h>

namespace renderer {
namespace {

class FlatIntegrator final : public carlo::Integrator {
 public:
  FlatIntegrator(const carlo::Scene& scene, std::uint64_t seed, const FlatChoices& choices)
      : scene_(scene), flat_(scene), seed_(seed), choices_(choices) {}

  std::string name() const override {
    return fmt::format(
        "vector path tracer, {}, {} solid boxes{}, {} parallelograms, {} spheres, {}",
        flat_.phong ? "phong" : "diffuse", flat_.solids.size(), flat_.enclosed ? " in another" : "",
        flat_.first_sphere - flat_.first_quad, flat_.surfaces - flat_.first_sphere,
        flat_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    const bool sobol = scene_.sampler == carlo::SamplerKind::sobol;
    render_flat({flat_, scene_.camera, scene_.width, scene_.height, scene_.max_depth,
                 carlo::stream_seed(seed_, tile.stream), sobol, tile, choices_},
                means, counts);
  }

 private:
  const carlo::Scene& scene_;
  FlatScene flat_;
  std::uint64_t seed_;
  FlatChoices choices_;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_flat_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const FlatChoices& choices) {
  return std::make_unique<FlatIntegrator>(scene, seed, choices);
}

}  // namespace renderer
