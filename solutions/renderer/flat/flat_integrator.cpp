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
    std::string text = fmt::format("vector path tracer, {}", flat_.phong ? "phong" : "diffuse");
    add(text, flat_.solids.size(), flat_.enclosed ? "boxes in a box" : "boxes");
    add(text, flat_.first_sphere - flat_.first_quad, "other parallelograms");
    add(text, flat_.surfaces - flat_.first_sphere, "spheres");
    return fmt::format("{}, {}", text, flat_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    render_flat({flat_, scene_.camera, scene_.width, scene_.height, scene_.max_depth,
                 carlo::stream_seed(seed_, tile.stream), flat_.sobol, tile, choices_},
                means, counts);
  }

 private:
  /// What the scene does not have is not told.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

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
