#pragma once

#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace renderer {

// Parallelograms of one plane, as a ceiling of lamps, are asked about together; a ray that meets
// the plane is asked about those patches of them whose place it comes near to.

/// The parallelograms of these numbers among the scene's shapes in another order: those of a plane
/// in a row, and in it those that lie together side by side.
std::vector<std::size_t> in_patches(const carlo::Scene& scene, std::vector<std::size_t> quads);

/// Fills in where the patches of these are, which have the numbers from `lanes.first_quad` on, once
/// all else of them is known.
void bound_patches(const carlo::Scene& scene, const std::vector<std::size_t>& quads,
                   LaneScene& lanes);

}  // namespace renderer
