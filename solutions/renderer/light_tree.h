#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace renderer {

/// What the choice of a light goes by: where it is, which way it faces and how bright it is; of one
/// light or of several together.
struct LightBounds {
  glm::dvec3 lower{0}, upper{0};  ///< a box around it
  glm::dvec3 axis{0};             ///< its normals lie in the cone about this unit vector
  double cos_spread = -1;  ///< of that half-angle (pi at most: -1); it emits in front of them
  /// Radiant intensity along the normals, R + G + B: radiance times area of what is flat.
  double strength = 0;
  /// Of the choices that are for all lights alike (LightTree::floor) in relation to others': a
  /// triangle of a lamp has its part of the lamp's.
  double floor_share = 1;
};

/// The irradiance (R + G + B) that a light brings, unoccluded, to the point p of a surface whose
/// normal n stands on the side that is lit: about that. 0 only where the light cannot contribute.
double estimate_irradiance(const LightBounds& light, glm::dvec3 p, glm::dvec3 n);

/// Chooses one of many lights with a chance that grows with what it can bring to a point, in a time
/// that grows with the logarithm of their number: a binary tree, descended by the estimates of both
/// sides. No light's chance is below its share of `floor`: that over their number, where all have
/// the same.
/// Sources: Conty Estevez, Kulla, "Importance sampling of many lights with adaptive tree
/// splitting", HPG 2018; Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
/// section 12.6.3.
class LightTree {
 public:
  static constexpr double floor = 1.0 / 16;

  /// One light at least. `everywhere`: one more, behind the others, which brings this irradiance to
  /// each point: what surrounds the scene.
  explicit LightTree(const std::vector<LightBounds>& lights,
                     std::optional<double> everywhere = std::nullopt);

  struct Choice {
    std::uint32_t light;
    double chance;  ///< > 0
    double u;       ///< in [0, 1), uniform again
  };
  /// u in [0, 1) with more digits than a float: of a chance of 1e-6 they leave but four bits.
  /// Nothing where no light of those that u leads to can contribute.
  std::optional<Choice> sample(carlo::Vec3 p, carlo::Vec3 n, double u) const;

  /// With which sample() chooses a light.
  double chance(std::uint32_t light, carlo::Vec3 p, carlo::Vec3 n) const;

  /// The lights in so many groups at most, each a part of the tree: the strongest of large extent
  /// are split first. Not what is everywhere.
  std::vector<std::vector<std::uint32_t>> groups(std::size_t most) const;

  /// Of all together; not of what is everywhere.
  const LightBounds& bounds() const { return bounds_; }

 private:
  /// A cache line: LightBounds as the descent reads them, a sphere around the light, the cone of
  /// its normals, and its strength over that of all. Siblings are side by side: i and i ^ 1. The
  /// root, 0, has none.
  struct alignas(64) Node {
    Node() = default;
    Node(const LightBounds& light, double strength);
    [[gnu::always_inline]] float estimate(carlo::Vec3 p, carlo::Vec3 n) const;

    carlo::Vec3 middle{0}, axis{0};
    float reach = 0, cos_spread = -1, sin_spread = 0, strength = 0;
    std::uint32_t parent = 0;
    std::uint32_t first_child = 0;  ///< 0: a leaf,
    std::uint32_t light = 0;        ///< of this light
  };
  struct Builder;
  friend double estimate_irradiance(const LightBounds& light, glm::dvec3 p, glm::dvec3 n);

  static constexpr std::uint32_t nowhere = 0xFFFFFFFF;

  float estimate(std::uint32_t node, carlo::Vec3 p, carlo::Vec3 n) const;
  /// Of a pair of siblings; nothing if neither can contribute.
  std::optional<double> chance_of_left(std::uint32_t left, carlo::Vec3 p, carlo::Vec3 n) const;
  void collect(std::uint32_t node, std::vector<std::uint32_t>& lights) const;
  double floor_chance(std::uint32_t light) const;
  double chance_by_descent(std::uint32_t light, carlo::Vec3 p, carlo::Vec3 n) const;

  std::vector<Node> nodes_;
  std::uint32_t everywhere_ = nowhere;  ///< the node of what is
  std::uint32_t root_ = 0;              ///< of all but that
  std::vector<std::uint32_t> leaf_of_;
  std::vector<double> floor_shares_;  ///< their running sum
  LightBounds bounds_;
};

/// The element of a running sum that u, in [0, 1), falls into; u becomes its place within.
std::size_t pick(std::span<const double> sums, double& u);

/// A u of 24 bits as one of 53: the digits below are a hash of this u and of the others that the
/// same sample uses, so that they are uniform and the sample needs no further random number.
double with_more_digits(float u, carlo::Vec2 others);

/// The float next to u in [0, 1).
float below_one(double u);

}  // namespace renderer
