#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace renderer {

/// An axis-aligned box around a shape.
struct Extent {
  glm::dvec3 lower, upper;
};

/// A hierarchy of boxes over shapes of one kind, for scenes with too many to test one by one
/// (tree-inl.h). Boxes exceed their shapes by more than the rounding of coordinates.
struct LaneTree {
  static constexpr std::size_t width = 16;           ///< children of a node, at most
  static constexpr std::size_t deepest = 32;         ///< nodes on a path from the root, at most
  static constexpr std::uint32_t leaf = 0x80000000;  ///< set in `child` if it is some Shapes
  static constexpr std::size_t most_shapes = 4;      ///< in one of those

  /// The boxes of unused children lie at infinity.
  struct alignas(64) Node {
    std::array<std::array<float, width>, 3> lower, upper;
    std::array<std::uint32_t, width> child;
  };
  std::vector<Node> nodes;  ///< the root first; none if there are no shapes

  /// The shapes of a child, which have consecutive numbers.
  struct Shapes {
    std::uint32_t first, count;

    std::uint32_t child() const { return leaf | count << bits | first; }
    static Shapes of(std::uint32_t child) {
      return {child & ((1u << bits) - 1), (child & ~leaf) >> bits};
    }

   private:
    static constexpr int bits = 24;
  };

  /// Builds a tree over surfaces with numbers from `first` on. `order` receives which of the
  /// extents gets which number: numbers grow from a node's first child to its last.
  LaneTree(const std::vector<Extent>& extents, std::uint32_t first,
           std::vector<std::size_t>& order);
  LaneTree() = default;
};

}  // namespace renderer
