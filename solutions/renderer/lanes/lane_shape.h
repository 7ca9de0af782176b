#pragma once

#include "cli/error.h"
#include "scene/match.h"
#include "scene/scene.h"

#include <type_traits>
#include <utility>

namespace renderer {

/// What the case for a shape that the kernels draw gives. LaneScene::suits() lets no others come.
template <class OfQuad, class OfSphere>
auto match_lanes(const carlo::Shape& shape, OfQuad of_quad, OfSphere of_sphere) {
  using Result = std::invoke_result_t<OfQuad, const carlo::Parallelogram&>;
  const auto no = [](const char* shapes) {
    return carlo::Error("the vector kernel draws no {}", shapes);
  };
  return carlo::match(
      shape.geometry, std::move(of_quad), std::move(of_sphere),
      [&](const carlo::Disk&) -> Result { throw no("disks"); },
      [&](const carlo::Mesh&) -> Result { throw no("meshes"); },
      [&](const carlo::Sdf&) -> Result { throw no("signed distance functions"); });
}

}  // namespace renderer
