#pragma once

#include "renderer/lanes/lane_boxes.h"
#include "scene/scene.h"

#include <optional>

namespace renderer {

// Decides whether rays test all surfaces of a scene one by one, or find those near them by trees
// (LaneScene::many).

/// The boxes of a scene if all of its surfaces are tested one by one; nothing if there are too
/// many.
std::optional<LaneBoxes> boxes_to_try(const carlo::Scene& scene);

/// All parallelograms by themselves.
LaneBoxes no_boxes(const carlo::Scene& scene);

}  // namespace renderer
