#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace renderer {

/// The properties of a light, or of several together, that its choice depends on: position,
/// orientation and brightness.
struct LightBounds {
  glm::dvec3 lower{0}, upper{0};  ///< a box around it
  glm::dvec3 axis{0};             ///< the axis (a unit vector) of the cone that holds its normals
  double cos_spread = -1;  ///< the cone's half-angle (at most pi: -1); it emits in front of its
                           ///< normals
  /// Radiant intensity along the normals, R + G + B: radiance times area for flat lights.
  double strength = 0;
  /// Its relative weight in the uniform part of the selection (LightTree::floor); the triangles of
  /// a light split its weight.
  double floor_share = 1;
};

/// Estimates the unoccluded irradiance (R + G + B) from a light at the point p of a surface whose
/// normal n is on the lit side. 0 only where the light cannot contribute.
double estimate_irradiance(const LightBounds& light, glm::dvec3 p, glm::dvec3 n);

/// Chooses one of many lights with a probability that grows with its possible contribution at a
/// point, in time logarithmic in their number: a binary tree, descended by the estimates of both
/// children. No light's probability is below its share of `floor`, which is `floor` over the number
/// of lights if all have the same share. Sources: Conty Estevez, Kulla, "Importance sampling of
/// many lights with adaptive tree splitting", HPG 2018; Pharr, Jakob, Humphreys, "Physically Based
/// Rendering", 4th ed., section 12.6.3.
class LightTree {
 public:
  static constexpr double floor = 1.0 / 16;

  /// Needs at least one light. `everywhere`, the irradiance due to the environment, becomes one
  /// more light after the others.
  explicit LightTree(const std::vector<LightBounds>& lights,
                     std::optional<double> everywhere = std::nullopt);

  struct Choice {
    std::uint32_t light;
    double probability;  ///< > 0
    double u;            ///< in [0, 1), uniform again
  };
  /// u in [0, 1) needs more digits than a float: a probability of 1e-6 would leave only four bits
  /// of one. Returns nothing if no light that u selects can contribute.
  std::optional<Choice> sample(carlo::Vec3 p, carlo::Vec3 n, double u) const;

  /// The probability with which sample() chooses a light.
  double probability(std::uint32_t light, carlo::Vec3 p, carlo::Vec3 n) const;

  /// Splits the lights into at most this many groups, each a part of the tree; strong groups of
  /// large extent are split first. Leaves out `everywhere`.
  std::vector<std::vector<std::uint32_t>> groups(std::size_t most) const;

  /// The bounds of all lights together, without `everywhere`.
  const LightBounds& bounds() const { return bounds_; }

 private:
  /// One cache line. LightBounds as the descent reads them: a sphere around the light, the cone of
  /// its normals, and its strength as a fraction of the total. Siblings are adjacent: i and i ^ 1.
  /// The root, 0, has none.
  struct alignas(64) Node {
    Node() = default;
    Node(const LightBounds& light, double strength);
    [[gnu::always_inline]] float estimate(carlo::Vec3 p, carlo::Vec3 n) const;

    carlo::Vec3 middle{0}, axis{0};
    float reach = 0, cos_spread = -1, sin_spread = 0, strength = 0;
    std::uint32_t parent = 0;
    std::uint32_t first_child = 0;  ///< 0: a leaf
    std::uint32_t light = 0;        ///< the leaf's light
  };
  struct Builder;
  friend double estimate_irradiance(const LightBounds& light, glm::dvec3 p, glm::dvec3 n);

  static constexpr std::uint32_t nowhere = 0xFFFFFFFF;

  float estimate(std::uint32_t node, carlo::Vec3 p, carlo::Vec3 n) const;
  /// The probability of the left one of two siblings; nothing if neither can contribute.
  std::optional<double> probability_of_left(std::uint32_t left, carlo::Vec3 p, carlo::Vec3 n) const;
  void collect(std::uint32_t node, std::vector<std::uint32_t>& lights) const;
  double floor_probability(std::uint32_t light) const;
  double probability_by_descent(std::uint32_t light, carlo::Vec3 p, carlo::Vec3 n) const;

  std::vector<Node> nodes_;
  std::uint32_t everywhere_ = nowhere;  ///< the node of `everywhere`
  std::uint32_t root_ = 0;              ///< the node of all other lights
  std::vector<std::uint32_t> leaf_of_;
  std::vector<double> floor_shares_;  ///< running sum of the floor shares
  LightBounds bounds_;
};

/// Finds the element of a running sum that u, in [0, 1), selects; u becomes its position within.
std::size_t pick(std::span<const double> sums, double& u);

/// Extends a u of 24 bits to 53. The digits below are a hash of this u and of the sample's other
/// numbers, so that they are uniform and cost no further random number.
double with_more_digits(float u, carlo::Vec2 others);

/// The largest float not above u that is below 1.
float below_one(double u);

}  // namespace renderer
