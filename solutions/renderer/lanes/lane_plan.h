#pragma once

#include "renderer/lanes/lane_boxes.h"
#include "renderer/lanes/lane_tree.h"
#include "renderer/warp.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace renderer {

struct LaneScene;

/// The square around a disk.
inline carlo::Parallelogram square_around(const carlo::Disk& disk) {
  const Frame frame(disk.normal);
  return {disk.center - disk.radius * (frame.s + frame.t), 2 * disk.radius * frame.s,
          2 * disk.radius * frame.t};
}

inline std::array<glm::dvec3, 4> corners(const carlo::Parallelogram& quad) {
  const glm::dvec3 o(quad.origin), u(quad.u), v(quad.v);
  return {o, o + u, o + v, o + u + v};
}

/// True for shapes that are no parallelograms, and so in no box.
bool in_no_box(const carlo::Shape& shape);

Extent extent_of(const carlo::Shape& shape);

/// Computes LaneScene::touching; `quads` are the parallelograms outside boxes.
bool any_touches(const carlo::Scene& scene, const std::vector<std::size_t>& quads);

// Decides whether rays test all surfaces of a scene one by one, or find those near them by trees
// (LaneScene::many).

/// The boxes of a scene if all of its surfaces are tested one by one; nothing if there are too
/// many.
std::optional<LaneBoxes> boxes_to_try(const carlo::Scene& scene);

/// All parallelograms by themselves.
LaneBoxes no_boxes(const carlo::Scene& scene);

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
