#pragma once

#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace renderer {

// Parallelograms of one plane, such as a ceiling of lights, are tested together; a ray that meets
// the plane is tested against those patches that it comes close to.

/// Reorders the parallelograms with these numbers among the scene's shapes: those of a plane in a
/// row, and neighbours within the plane side by side.
std::vector<std::size_t> in_patches(const carlo::Scene& scene, std::vector<std::size_t> quads);

/// Fills in the extents of the patches of these parallelograms, which have the numbers from
/// `lanes.first_quad` on, once everything else about them is known.
void bound_patches(const carlo::Scene& scene, const std::vector<std::size_t>& quads,
                   LaneScene& lanes);

}  // namespace renderer
