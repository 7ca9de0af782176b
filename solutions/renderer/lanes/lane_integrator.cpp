#include "renderer/lanes/lane_integrator.h"

#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace renderer {
namespace {

class LaneIntegrator final : public carlo::Integrator {
 public:
  LaneIntegrator(const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices,
                 const LaneTrials& trials)
      : scene_(scene), lanes_(scene), seed_(seed), choices_(choices) {
    choices_.light_paths *= lanes_.has_path_starts() ? light_paths_per_path(lanes_) : 0;
    if (choices_.lights_apart && scene.max_depth != 1)
      lights_apart_ = seen_lights(lanes_, scene.camera, scene.width, scene.height);
    if (!trials.any()) return;
    const auto start = std::chrono::steady_clock::now();
    guide_ = decide(scene, lanes_, seed, trials, choices_);
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
    // A render is continued only with as many: others would be the same paths again.
    if (choices_.light_paths > 0 && choices_.light_paths < 1)
      text += fmt::format(" ({} a path)", choices_.light_paths);
    if (guide_) text += ", guided";
    if (choices_.share) text += ", shared";
    return fmt::format("{}, {}", text, lane_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    render_blocks(tile, 1, means, counts);
  }

  void render_blocks(const carlo::Tile& tile, std::uint32_t blocks,
                     std::span<std::array<double, 3>> means, carlo::Counts& counts) const override {
    const LaneChoices choices = with_share(tile.light_path_share);
    LaneJob of_tile = job(tile, choices);
    of_tile.blocks = blocks;
    check_sides(of_tile);
    render_lanes(of_tile, means, counts);
  }

  double seconds_spent() const override { return seconds_spent_; }

  double least_light_probability() const override {
    const bool samples_lights = scene_.max_depth != 1;  // pixels see them
    return samples_lights && lanes_.lights > 1 ? LightTree::floor / lanes_.lights : 1;
  }

  double light_paths() const override { return choices_.light_paths; }

  void trace_light_paths(const carlo::LightPaths& paths, carlo::Splats& splats,
                         carlo::Counts& counts) const override {
    const carlo::Tile any{.stream = paths.stream};
    const LaneChoices choices = with_share(paths.share);
    const LaneJob whole = job(any, choices);
    renderer::trace_light_paths({whole, paths.first, paths.count, splats.unit()}, splats, counts);
  }

  double splat_unit(std::uint64_t paths) const override { return lanes_.splat_unit(paths); }

 private:
  LaneChoices with_share(double light_path_share) const {
    LaneChoices choices = choices_;
    choices.light_paths *= static_cast<float>(light_path_share);
    return choices;
  }

  LaneJob job(const carlo::Tile& tile, const LaneChoices& choices) const {
    return {lanes_,
            scene_.camera,
            scene_.width,
            scene_.height,
            scene_.max_depth,
            carlo::stream_seed(seed_, tile.stream),
            lanes_.sobol,
            tile,
            choices,
            1,
            guide_ ? &*guide_ : nullptr,
            nullptr,
            lights_apart_};
  }

  /// Throws Error if pixels would share with others that are not in the tile.
  static void check_sides(const LaneJob& job) {
    constexpr int step = carlo::sharing_pixels;
    const carlo::Tile& t = job.tile;
    const bool whole = t.x0 % step == 0 && t.y0 % step == 0 &&
                       (t.x1 % step == 0 || t.x1 == job.width) &&
                       (t.y1 % step == 0 || t.y1 == job.height);
    if (job.shares() && !whole) {
      throw carlo::Error(
          "a tile whose pixels share has sides that are multiples of {}, not [{}, {}) x [{}, {})",
          step, t.x0, t.x1, t.y0, t.y1);
    }
  }

  /// Adds a count to the text; zero counts are left out.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

  const carlo::Scene& scene_;
  LaneScene lanes_;
  std::uint64_t seed_;
  LaneChoices choices_;
  std::vector<FilmRectangle> lights_apart_;
  std::optional<Guide> guide_;
  double seconds_spent_ = 0;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        const LaneTrials& trials) {
  if (lane_instruction_sets().empty()) {
    throw carlo::Error(
        "the vector kernel was compiled for another kind of processor than this machine's; configure "
        "with cmake --preset release -DCARLO_EVERY_INSTRUCTION_SET=ON and build again to support "
        "all kinds, or render with --kernel scalar");
  }
  return std::make_unique<LaneIntegrator>(scene, seed, choices, trials);
}

}  // namespace renderer
