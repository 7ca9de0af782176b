#pragma once

#include "numeric/vec.h"
#include "scene/scene.h"

#include <optional>

namespace renderer {

using carlo::Rgb;
using carlo::Vec2;
using carlo::Vec3;

/// Lafortune and Willems' modified Phong BRDF, Lambert's for ks = 0:
///   f = kd/pi + ks (n+2)/(2 pi) cos^n(alpha),
/// alpha the angle between wi and the mirror direction of wo. Directions are unit vectors in world
/// space that point away from the surface; `normal` is on wo's side. The cosine of the rendering
/// equation is not part of f.
/// Source: Lafortune and Willems, "Using the modified Phong reflectance model for physically based
/// rendering", 1994.
class ModifiedPhong {
 public:
  ModifiedPhong(Rgb kd, Rgb ks, float exponent);

  /// The value f and the density (per solid angle) with which sample() gives wi; both are 0 for wi
  /// below the horizon.
  struct Value {
    Rgb f;
    float pdf;
  };
  Value evaluate(Vec3 normal, Vec3 wo, Vec3 wi) const;

  /// A direction and what it carries: weight = f cos(theta_i) / pdf. Nothing when the direction
  /// falls below the horizon: the missing part of the lobe is absorbed, never drawn again.
  struct Sample {
    Vec3 wi;
    Rgb weight;
    float pdf;
  };
  std::optional<Sample> sample(Vec3 normal, Vec3 wo, float u_lobe, Vec2 u) const;

  bool black() const { return kd_ == Rgb(0) && ks_ == Rgb(0); }

 private:
  Rgb kd_, ks_;
  float exponent_;
  float diffuse_probability_;  ///< of drawing from the diffuse lobe: mean kd / mean (kd + ks)
};

/// Smooth glass. Both directions point away from the surface.
struct Refraction {
  float reflectance;       ///< Fresnel's, unpolarised; 1 for total internal reflection
  std::optional<Vec3> wt;  ///< the refracted direction
  float eta;               ///< index of refraction on wo's side over that on the other side
};

/// `normal` lies on wo's side; `eta` as in Refraction.
Refraction refract(Vec3 normal, Vec3 wo, float eta);

inline Vec3 reflect(Vec3 normal, Vec3 wo) {
  return 2 * glm::dot(normal, wo) * normal - wo;
}

}  // namespace renderer
