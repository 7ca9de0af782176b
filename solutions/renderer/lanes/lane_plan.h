#pragma once

#include "renderer/lanes/lane_boxes.h"
#include "scene/scene.h"

#include <optional>

namespace renderer {

// Whether a ray tries each surface of a scene, or trees find those near it (LaneScene::many).

/// The boxes of a scene if all of its surfaces are tried; nothing if they are too many.
std::optional<LaneBoxes> boxes_to_try(const carlo::Scene& scene);

/// All parallelograms by themselves.
LaneBoxes no_boxes(const carlo::Scene& scene);

}  // namespace renderer
