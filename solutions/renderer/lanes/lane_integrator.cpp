#include "renderer/lanes/lane_integrator.h"

#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_pilot.h"
#include "support/error.h"

#include <fmt/core.h>

#include <chrono>

namespace renderer {
namespace {

class LaneIntegrator final : public carlo::Integrator {
 public:
  LaneIntegrator(const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices,
                 std::optional<std::uint32_t> pilot_spp)
      : scene_(scene), lanes_(scene), seed_(seed), choices_(choices) {
    if (!pilot_spp) return;
    const auto start = std::chrono::steady_clock::now();
    choices_.light_paths = try_light_paths(scene, lanes_, seed, *pilot_spp) ? 1.0f : 0.0f;
    seconds_spent_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  std::string name() const override {
    std::string text = fmt::format("vector path tracer, {}", lanes_.phong ? "phong" : "diffuse");
    add(text, lanes_.solids.size(), lanes_.enclosed ? "boxes in a box" : "boxes");
    add(text, lanes_.first_disk - lanes_.first_quad, "other parallelograms");
    add(text, lanes_.first_sphere - lanes_.first_disk, "disks");
    add(text, lanes_.first_sdf - lanes_.first_sphere, "spheres");
    add(text, lanes_.sdfs.size(), "sdfs");
    add(text, lanes_.surfaces - lanes_.first_mesh, "meshes");
    if (choices_.light_paths > 0) text += ", light paths";
    return fmt::format("{}, {}", text, lane_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    const LaneChoices choices = shared(tile.light_path_share);
    render_lanes(job(tile, choices), means, counts);
  }

  double seconds_spent() const override { return seconds_spent_; }

  double least_light_chance() const override {
    return lanes_.lights > 1 ? LightTree::floor / lanes_.lights : 1;
  }

  std::uint32_t light_paths() const override {
    return static_cast<std::uint32_t>(choices_.light_paths);
  }

  void trace_light_paths(const carlo::LightPaths& paths, carlo::Splats& splats,
                         carlo::Counts& counts) const override {
    const carlo::Tile any{.stream = paths.stream};
    const LaneChoices choices = shared(paths.share);
    const LaneJob whole = job(any, choices);
    renderer::trace_light_paths({whole, paths.first, paths.count, splats.unit()}, splats, counts);
  }

  double splat_unit(std::uint64_t paths) const override { return lanes_.splat_unit(paths); }

 private:
  LaneChoices shared(double light_path_share) const {
    LaneChoices choices = choices_;
    choices.light_paths *= static_cast<float>(light_path_share);
    return choices;
  }

  LaneJob job(const carlo::Tile& tile, const LaneChoices& choices) const {
    return {lanes_,           scene_.camera,
            scene_.width,     scene_.height,
            scene_.max_depth, carlo::stream_seed(seed_, tile.stream),
            lanes_.sobol,     tile,
            choices};
  }

  /// Adds a count to the text; zero counts are left out.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

  const carlo::Scene& scene_;
  LaneScene lanes_;
  std::uint64_t seed_;
  LaneChoices choices_;
  double seconds_spent_ = 0;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        std::optional<std::uint32_t> pilot_spp) {
  if (lane_instruction_sets().empty()) {
    throw carlo::Error(
        "the vector kernel was compiled for another kind of processor than this machine's; configure "
        "with cmake --preset release -DCARLO_EVERY_INSTRUCTION_SET=ON and build again to support "
        "all kinds, or render with --kernel scalar");
  }
  return std::make_unique<LaneIntegrator>(scene, seed, choices, pilot_spp);
}

}  // namespace renderer
