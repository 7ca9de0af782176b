#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace bench {

/// Why Blender's Cycles cannot render this scene exactly as we do ("spheres", "a point light"), or
/// nothing if it can. Its curved shapes are polygons and its lights have colours of their own, so
/// that only diffuse parallelograms and meshes, lit by some of them, are the same scene in both.
std::optional<std::string> cycles_obstacle(const carlo::Scene& scene);

/// The scene in the words of cycles.py: film, bounces, camera, meshes and materials. Coordinates
/// are ours times a power of two (the largest lies in [1/2, 1)), radiances ours. Faces are
/// counter-clockwise about the normal. Throws Error if there is an obstacle. The caller adds
/// "samples", "seed" and "output".
nlohmann::json cycles_scene(const carlo::Scene& scene);

}  // namespace bench
