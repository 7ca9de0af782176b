#include "renderer/lanes/lane_integrator.h"

#include "renderer/lanes/lane_kernel.h"

#include <fmt/core.h>

namespace renderer {
namespace {

class LaneIntegrator final : public carlo::Integrator {
 public:
  LaneIntegrator(const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices)
      : scene_(scene), lanes_(scene), seed_(seed), choices_(choices) {}

  std::string name() const override {
    std::string text = fmt::format("vector path tracer, {}", lanes_.phong ? "phong" : "diffuse");
    add(text, lanes_.solids.size(), lanes_.enclosed ? "boxes in a box" : "boxes");
    add(text, lanes_.first_disk - lanes_.first_quad, "other parallelograms");
    add(text, lanes_.first_sphere - lanes_.first_disk, "disks");
    add(text, lanes_.first_sdf - lanes_.first_sphere, "spheres");
    add(text, lanes_.sdfs.size(), "sdfs");
    add(text, lanes_.surfaces - lanes_.first_mesh, "meshes");
    return fmt::format("{}, {}", text, lane_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    render_lanes({lanes_, scene_.camera, scene_.width, scene_.height, scene_.max_depth,
                  carlo::stream_seed(seed_, tile.stream), lanes_.sobol, tile, choices_},
                 means, counts);
  }

 private:
  /// What the scene does not have is not told.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

  const carlo::Scene& scene_;
  LaneScene lanes_;
  std::uint64_t seed_;
  LaneChoices choices_;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices) {
  return std::make_unique<LaneIntegrator>(scene, seed, choices);
}

}  // namespace renderer
