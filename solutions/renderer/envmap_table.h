#pragma once

#include "numeric/vec.h"
#include "scene/envmap.h"

#include <array>
#include <cstddef>
#include <vector>

namespace renderer {

/// An image around the scene as a lamp: directions of a density in proportion to its luminance.
///
/// The point (s, t) of the image, in [0, 1)^2, stands for the direction of azimuth phi = 2 pi s and
/// polar angle theta = pi t, so that d(omega) = 2 pi^2 sin(theta) ds dt, and a density p(s, t) is
/// p / (2 pi^2 sin(theta)) per solid angle. What is drawn is in proportion to L sin(theta) over the
/// image. Since a texel has one luminance, its integral of that is L times its solid angle: a texel
/// is chosen by it, and inside it phi and cos(theta) are uniform, which is uniform per solid angle.
/// So the density is the texel's chance over its solid angle, in proportion to L alone, and no
/// sin(theta) divides by 0 at the poles.
///
/// Row and column are drawn by inversion: neighbours among sample points stay neighbours, unlike
/// with an alias table. The running sums are whole multiples of 2^-24, the step of the u's: the
/// density is that with which directions are drawn, not one that is off by the sums' rounding. A
/// texel of less than that is never drawn and has density 0, as black ones have.
/// Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 12.5.
struct EnvmapTable {
  explicit EnvmapTable(const carlo::Envmap& map);

  struct Sample {
    carlo::Vec3 wi;  ///< of the scene, of length 1
    carlo::Rgb radiance;
    float pdf;  ///< per solid angle, > 0
  };
  /// The direction that u in [0, 1)^2 is mapped to.
  Sample sample(carlo::Vec2 u) const;

  /// The radiance from a direction of the scene, of length 1, and the density with which sample()
  /// draws it, per solid angle.
  struct Texel {
    carlo::Rgb radiance;
    float pdf;
  };
  Texel at(carlo::Vec3 d) const;

  const carlo::Envmap* map;  ///< that it was made of; must outlive the table
  glm::mat3 rotation;        ///< its own
  std::size_t width, height;
  /// Running sums of chances, from 0 to 1: of the rows, and of each row's texels (width + 1 each;
  /// all 0 in black rows).
  std::vector<float> rows, columns;
  /// Of a row's upper and lower edge 1 - |cos(theta)|, counted from the pole that the row is next
  /// to: there the cosine itself would have no digits. `pole` is 1 in the upper half, else -1.
  std::vector<float> upper, lower, pole;
  /// Of each texel R, G, B and the density per solid angle.
  std::vector<std::array<float, 4>> texels;
  double brightness = 0;  ///< the integral of R + G + B over the sphere

 private:
  void add_row(std::size_t y, double chance, const std::vector<double>& luminances);
};

}  // namespace renderer
