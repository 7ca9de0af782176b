#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace renderer {

/// No parallelogram, so in no box.
bool in_no_box(const carlo::Shape& shape);

/// LaneScene::touching, `quads` the parallelograms outside of boxes.
bool any_touches(const carlo::Scene& scene, const std::vector<std::size_t>& quads);

}  // namespace renderer
