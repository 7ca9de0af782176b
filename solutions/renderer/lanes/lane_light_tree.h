#pragma once

#include "renderer/light_tree.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace renderer {

/// A light as the vector kernel chooses among several.
struct LaneLight {
  glm::dvec3 middle{0};  ///< of a sphere around it,
  double reach = 0;      ///< and its radius
  double strength = 0;   ///< radiance x area for flat lights, intensity for others; R + G + B
  double power = 0;      ///< power of paths that start here; 0 if none do
  struct Plane {
    glm::dvec3 normal;
    double d;
  };
  std::optional<Plane> plane = std::nullopt;  ///< of flat lights
  bool everywhere = false;                    ///< the environment map, whose strength is irradiance
};

/// For a LightTree of such lights, none of which is `everywhere`.
LightBounds bounds_of(const LaneLight& light);

/// Chooses among many lights by a tree of wide nodes, few of which lie on the path to a light
/// (light_tree-inl.h). The children of a node are chosen in proportion to an estimate of their
/// unoccluded irradiance; LightTree::floor of all choices are uniform.
struct LaneLightTree {
  static constexpr std::size_t width = 16;           ///< children of a node, at most
  static constexpr std::uint32_t leaf = 0x80000000;  ///< set in `child`: the rest numbers a light

  /// Each child's lights lie in a sphere; if all are flat and face the same way, they emit towards
  /// p only if normal . p > d. `round` is 1 for other children, and for unused ones, which have
  /// strength 0.
  struct alignas(64) Node {
    std::array<float, width> middle_x, middle_y, middle_z, reach, strength, nx, ny, nz, d, round;
    std::array<std::uint32_t, width> child;
    std::uint32_t parent = 0;
    std::uint32_t place = 0;  ///< among the parent's children
  };
  struct Leaf {
    std::uint32_t node, place;
  };
  std::vector<Node> nodes;    ///< the root first; none if the lights are few
  std::vector<Leaf> leaf_of;  ///< of each light
  std::uint32_t sky = width;  ///< the root's child that is the environment map, if there is one

  LaneLightTree() = default;
  explicit LaneLightTree(const std::vector<LaneLight>& lights);
};

}  // namespace renderer
