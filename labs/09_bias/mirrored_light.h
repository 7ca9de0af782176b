#pragma once

#include "bias.h"
#include "numeric/robust.h"

#include <cmath>

namespace lab09 {

/// A round light at height 1 that faces up, below a mirror and over a floor. Its power is pi,
/// however small it is. The floor sees it only in the mirror, and photons arrive only by way of the
/// mirror.
struct MirroredLight {
  static constexpr double reflectance = 0.9, albedo = 0.5;
  static constexpr double image_height = 1.6;  ///< of the light's mirror image
  static constexpr double away = 0.5;          ///< of three points, from the foot of the light

  /// At most .1: a larger one would hide part of its image from the points.
  explicit MirroredLight(double radius_) : radius(radius_), world(scene()) {}

  /// The radiance of the floor at the points, due to the light's mirror image alone.
  double exact() const {
    const double a2 = radius * radius, s = away * away + image_height * image_height;
    const double root = std::sqrt((s + a2) * (s + a2) - 4 * a2 * away * away);
    // (1 - (s - a2)/root)/2 without cancellation.
    const double share = 2 * a2 * image_height * image_height / (root * (root + s - a2));
    return albedo * reflectance * share * radiance();
  }

  /// A ray to the floor at point number i of three, or any other i.
  Ray ray(int i) const {
    const double turn = 2 * carlo::pi * i / 3;
    return {{static_cast<float>(away * std::cos(turn)), static_cast<float>(away * std::sin(turn)),
             0.5f},
            {0, 0, -1}};
  }

  double radius;
  World world;

 private:
  double radiance() const { return 1 / (carlo::pi * radius * radius); }

  carlo::Scene scene() const {
    carlo::Scene scene;
    scene.materials = {{carlo::Phong{Rgb(static_cast<float>(albedo)), Rgb(0), 0}, false},
                       {carlo::Mirror{Rgb(static_cast<float>(reflectance))}, false},
                       {carlo::Phong{Rgb(0), Rgb(0), 0}, false}};
    scene.shapes = {{carlo::Parallelogram{{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}}, 0, Rgb(0)},
                    {carlo::Parallelogram{{-4, -4, 1.3f}, {0, 8, 0}, {8, 0, 0}}, 1, Rgb(0)},
                    {carlo::Disk{{0, 0, 1}, {0, 0, 1}, static_cast<float>(radius)}, 2,
                     Rgb(static_cast<float>(radiance()))}};
    return scene;
  }
};

}  // namespace lab09
