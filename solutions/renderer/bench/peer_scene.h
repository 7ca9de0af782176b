#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace bench {

/// Other renderers, measured beside ours.
enum class Peer { cycles, mitsuba, luxcore };

/// Why this renderer cannot render the scene exactly as ours does ("spheres", "Phong's lobes"), or
/// nothing if it can. Cycles and LuxCore turn curved shapes into polygons, Cycles' lights have
/// colours of their own, and none of the three has the modified Phong BRDF.
std::optional<std::string> obstacle(const carlo::Scene& scene, Peer peer);

/// The scene as input for the programs that render it (peers/): film, depth, camera, materials,
/// meshes, spheres and lights. Coordinates are ours times a power of two (the largest lies in [1/2,
/// 1)), radiances ours. Faces are counter-clockwise about the normal; where the peer has no spheres
/// they are meshes of `peer_sphere_triangles`. Throws Error if there is an obstacle. The caller
/// adds the task: "samples", "seed", "output" and the peer's own options.
nlohmann::json peer_scene(const carlo::Scene& scene, Peer peer);

constexpr int peer_sphere_triangles = 20 * 4 * 4 * 4 * 4 * 4 * 4;

}  // namespace bench
