#pragma once

#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace renderer {

/// A parallelepiped among a scene's shapes.
struct FoundBox {
  LaneBox box;
  /// The shape that is each side, in the order of LaneBox::faces.
  std::array<std::optional<std::size_t>, 6> shape;
};

/// A scene's parallelograms, sorted into boxes as LaneScene wants them. Sides agree with their
/// shapes to a millionth of the box's size.
struct LaneBoxes {
  std::vector<FoundBox> solids;
  std::optional<FoundBox> enclosure;
  bool camera_inside = false;       ///< of the enclosure
  std::vector<std::size_t> others;  ///< parallelograms in no box
};

LaneBoxes find_boxes(const carlo::Scene& scene);

}  // namespace renderer
