#pragma once

#include "renderer/lanes/lane_tree.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace renderer {

/// True for shapes that are no parallelograms, and so in no box.
bool in_no_box(const carlo::Shape& shape);

Extent extent_of(const carlo::Shape& shape);

/// Computes LaneScene::touching; `quads` are the parallelograms outside boxes.
bool any_touches(const carlo::Scene& scene, const std::vector<std::size_t>& quads);

}  // namespace renderer
