#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>

namespace bench {

/// The film and the samples with which programs are compared: 128 x 128 pixels, 256 samples each.
constexpr int cost_size = 128;
constexpr std::uint32_t cost_samples = 256;

carlo::Scene load_cost_scene(const std::filesystem::path& path);

/// Renders on one thread, once to warm up and once by the stopwatch, and prints as JSON the
/// processor seconds a path, a hash of the image and the integrator's name.
void print_render_cost(const carlo::Integrator& integrator, const carlo::Scene& scene);

}  // namespace bench
