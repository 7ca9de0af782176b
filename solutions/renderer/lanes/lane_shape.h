#pragma once

#include "cli/error.h"
#include "renderer/frame.h"
#include "scene/match.h"
#include "scene/scene.h"

#include <array>
#include <type_traits>
#include <utility>

namespace renderer {

/// What the case for a shape that the kernels draw gives. LaneScene::suits() lets no others come.
template <class OfQuad, class OfDisk, class OfSphere, class OfSdf>
auto match_lanes(const carlo::Shape& shape, OfQuad of_quad, OfDisk of_disk, OfSphere of_sphere,
                 OfSdf of_sdf) {
  using Result = std::invoke_result_t<OfQuad, const carlo::Parallelogram&>;
  const auto no = [](const char* shapes) {
    return carlo::Error("the vector kernel draws no {}", shapes);
  };
  return carlo::match(shape.geometry, std::move(of_quad), std::move(of_disk), std::move(of_sphere),
                      std::move(of_sdf), [&](const carlo::Mesh&) -> Result { throw no("meshes"); });
}

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

}  // namespace renderer
