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
  /// The shape of each side, in the order of LaneBox::faces.
  std::array<std::optional<std::size_t>, 6> shape;
};

/// A scene's parallelograms, sorted into boxes for LaneScene. Sides match their shapes to a
/// millionth of the box's size.
struct LaneBoxes {
  std::vector<FoundBox> solids;
  std::optional<FoundBox> enclosure;
  bool camera_inside = false;       ///< inside the enclosure
  std::vector<std::size_t> others;  ///< parallelograms that are in no box
};

LaneBoxes find_boxes(const carlo::Scene& scene);

}  // namespace renderer
