#pragma once

#include "numeric/vec.h"
#include "scene/envmap.h"

#include <array>
#include <cstddef>
#include <vector>

namespace renderer {

/// Samples an environment map as a light: the density of directions is proportional to its
/// luminance.
///
/// The point (s, t) of the image, in [0, 1)^2, stands for the direction of azimuth phi = 2 pi s and
/// polar angle theta = pi t. So d(omega) = 2 pi^2 sin(theta) ds dt, and a density p(s, t) is p / (2
/// pi^2 sin(theta)) per solid angle. Over the image, the density is proportional to L sin(theta). A
/// texel has one luminance, so its integral is L times its solid angle: a texel is chosen by that,
/// and inside it phi and cos(theta) are uniform, which is uniform per solid angle. The density is
/// therefore the texel's probability over its solid angle, proportional to L alone, and no
/// sin(theta) divides by 0 at the poles.
///
/// Row and column are sampled by inversion, which keeps neighbouring sample points neighbours; an
/// alias table would not. The running sums are whole multiples of 2^-24, the step of the u's, so
/// the density is exactly that of the sampled directions. A texel with a smaller probability is
/// never sampled and has density 0, like black texels. Source: Pharr, Jakob, Humphreys, "Physically
/// Based Rendering", 4th ed., section 12.5.
struct EnvmapTable {
  explicit EnvmapTable(const carlo::Envmap& map);

  struct Sample {
    carlo::Vec3 wi;  ///< unit vector in scene space
    carlo::Rgb radiance;
    float pdf;  ///< per solid angle, > 0
  };
  /// Maps u in [0, 1)^2 to a direction.
  Sample sample(carlo::Vec2 u) const;

  /// The radiance from a unit direction in scene space, and the density per solid angle with which
  /// sample() draws it.
  struct Texel {
    carlo::Rgb radiance;
    float pdf;
  };
  Texel at(carlo::Vec3 d) const;

  const carlo::Envmap* map;  ///< the image that the table was made from; must outlive the table
  glm::mat3 rotation;        ///< the image's own
  std::size_t width, height;
  /// Running sums of probabilities, from 0 to 1: those of the rows, and those of each row's texels
  /// (width + 1 each; all 0 in black rows).
  std::vector<float> rows, columns;
  /// 1 - |cos(theta)| of each row's upper and lower edge, measured from the nearer pole, where the
  /// cosine itself would lose its digits. `pole` is 1 in the upper half, else -1.
  std::vector<float> upper, lower, pole;
  /// R, G, B and the density per solid angle of each texel.
  std::vector<std::array<float, 4>> texels;
  double brightness = 0;  ///< the integral of R + G + B over the sphere

 private:
  void add_row(std::size_t y, double probability, const std::vector<double>& luminances);
};

}  // namespace renderer
