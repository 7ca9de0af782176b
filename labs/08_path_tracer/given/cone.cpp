#include "given/cone.h"

#include "hemisphere.h"
#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

namespace lab08 {

Vec3 Cone::sample(Vec2 u) const {
  const float h = u.x * one_minus_cos;
  const float radius = carlo::safe_sqrt(h * (2 - h)), phi = 2 * carlo::pi_f * u.y;
  const lab07::Frame frame(axis);
  return frame.to_world({radius * std::cos(phi), radius * std::sin(phi), 1 - h});
}

// |w - axis|^2 / 2 = 1 - cos of the angle between them, without cancellation.
bool Cone::contains(Vec3 w) const {
  const Vec3 difference = w - axis;
  return 0.5f * glm::dot(difference, difference) < one_minus_cos;
}

float Cone::solid_angle() const {
  return 2 * carlo::pi_f * one_minus_cos;
}

// A cone of half-angle beta whose axis stands gamma above the horizon, |gamma| < beta, loses a
// segment of 2 [acos(sin gamma / sin beta) - cos beta acos(tan gamma / tan beta)].
float Cone::solid_angle_above(Vec3 normal) const {
  const double whole = 2 * carlo::pi * static_cast<double>(one_minus_cos);
  const double cos_beta = 1 - static_cast<double>(one_minus_cos);
  const double sin_beta =
      std::sqrt(static_cast<double>(one_minus_cos) * (2 - static_cast<double>(one_minus_cos)));
  const glm::dvec3 a(axis), n(normal);
  const double sin_gamma = glm::dot(a, n), cos_gamma = glm::length(glm::cross(a, n));
  if (sin_gamma >= sin_beta && cos_beta >= 0) return static_cast<float>(whole);
  if (sin_gamma <= -sin_beta && cos_beta >= 0) return 0;
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  const double segment = 2 * (angle(sin_gamma / sin_beta) -
                              cos_beta * angle(sin_gamma * cos_beta / (cos_gamma * sin_beta)));
  return static_cast<float>(whole - segment);
}

Cone cone_of(Vec3 center, float radius, Vec3 from) {
  const glm::dvec3 d = glm::dvec3(center) - glm::dvec3(from);
  const double sin2 = static_cast<double>(radius) * static_cast<double>(radius) / glm::dot(d, d);
  const double cosine = std::sqrt(std::max(0.0, 1 - sin2));
  return {Vec3(glm::normalize(d)), static_cast<float>(sin2 / (1 + cosine))};
}

}  // namespace lab08
