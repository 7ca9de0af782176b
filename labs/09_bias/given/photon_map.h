#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace lab09 {

using carlo::Rgb;
using carlo::Vec3;

/// Light that arrived at a surface.
struct Photon {
  Vec3 p;
  Vec3 wi;                      ///< unit vector towards its origin
  Rgb flux{0};                  ///< the power that it carries
  int phong = 0, specular = 0;  ///< the numbers of Phong surfaces, and of mirrors and glass, that
                                ///< it met before

  /// True if only mirrors or glass, and at least one, lie between the light and here.
  bool caustic() const { return phong == 0 && specular > 0; }
};

/// Photons by position: a balanced k-d tree in an array. The middle of a range is a node, and the
/// parts before and after it are the node's subtrees; short ranges are leaves. Distances and their
/// squares are floats: right for lengths from 1e-15 to 1e15.
class PhotonMap {
 public:
  PhotonMap() = default;
  /// Multiplies every flux by `scale`: 1/n if n photons were emitted. Throws carlo::Error if a
  /// photon's position is not finite.
  PhotonMap(std::vector<Photon> photons, float scale);

  std::size_t size() const { return photons_.size(); }
  /// Calls `use` with the squared distance for each photon nearer to p than `radius`, in any order:
  /// for none if the radius is not above 0, for all if it is infinite.
  void within(Vec3 p, float radius,
              const std::function<void(const Photon&, float distance2)>& use) const;
  /// The k nearest photons, or all if there are fewer, nearest first.
  std::vector<const Photon*> nearest(Vec3 p, int k) const;

  /// A photon's position and, if it is a node, the axis across which it splits its range.
  struct Place {
    Vec3 p;
    std::uint32_t axis;
  };

 private:
  std::vector<Place> places_;
  std::vector<Photon> photons_;  ///< in the same order
};

}  // namespace lab09
