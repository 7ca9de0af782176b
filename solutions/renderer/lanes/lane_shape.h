#pragma once

#include "renderer/frame.h"
#include "scene/scene.h"

#include <array>

namespace renderer {

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
