#include "spherical_rectangle.h"

#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

double square(double x) {
  return x * x;
}

}  // namespace

RectangleFrame::RectangleFrame(const carlo::Parallelogram& rectangle)
    : origin(rectangle.origin),
      x(glm::normalize(glm::dvec3(rectangle.u))),
      y(glm::normalize(glm::dvec3(rectangle.v))),
      z(glm::normalize(glm::cross(x, y))),
      width(glm::length(glm::dvec3(rectangle.u))),
      height(glm::length(glm::dvec3(rectangle.v))) {}

SphericalRectangle::SphericalRectangle(const RectangleFrame& rectangle, Vec3 from)
    : origin_(rectangle.origin), x_(rectangle.x), y_(rectangle.y) {
  const glm::dvec3 d = rectangle.origin - glm::dvec3(from);
  x0_ = glm::dot(d, x_);
  y0_ = glm::dot(d, y_);
  // The local z axis points away from the rectangle.
  z0_ = -std::abs(glm::dot(d, rectangle.z));
  x1_ = x0_ + rectangle.width;
  y1_ = y0_ + rectangle.height;
  // The solid angle is the sum of the angles between neighbouring planes through `from` and an
  // edge, less 2 pi. The angles come from their sine and cosine: at grazing angles they are near 0
  // or pi, where an arc cosine would lose half of the digits.
  const double z2 = square(z0_), height = -z0_;
  const auto angle = [&](double x, double y, double sign) {
    return std::atan2(height * std::sqrt(square(x) + square(y) + z2), sign * x * y);
  };
  const double g0 = angle(x1_, y0_, 1), g1 = angle(x1_, y1_, -1), g2 = angle(x0_, y1_, 1),
               g3 = angle(x0_, y0_, -1);
  b0_ = -y0_ / std::sqrt(z2 + square(y0_));
  b1_ = y1_ / std::sqrt(z2 + square(y1_));
  k_ = 2 * carlo::pi - g2 - g3;
  solid_angle_ = z0_ < 0 ? std::max(0.0, g0 + g1 - k_) : 0;
}

Vec3 SphericalRectangle::sample(Vec2 u) const {
  // The slice of the rectangle left of the sample has the fraction u.x of the solid angle ...
  const double angle = static_cast<double>(u.x) * solid_angle_ + k_;
  const double fu = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
  double cu = std::copysign(1.0, fu) / std::sqrt(square(fu) + square(b0_));
  cu = std::clamp(cu, -1.0, 1.0);
  const double xu = std::clamp(-(cu * z0_) / std::max(std::sqrt(1 - square(cu)), 1e-12), x0_, x1_);
  // ... and along that slice's line the height is uniform on the sphere.
  const double d = std::sqrt(square(xu) + square(z0_));
  const double h0 = y0_ / std::sqrt(square(d) + square(y0_)),
               h1 = y1_ / std::sqrt(square(d) + square(y1_));
  const double h = h0 + static_cast<double>(u.y) * (h1 - h0), h2 = square(h);
  const double yv = h2 < 1 - 1e-12 ? h * d / std::sqrt(1 - h2) : y1_;
  // From the rectangle's own corner, so that the point is as accurate as its plane, however far
  // away `from` is.
  return Vec3(origin_ + (xu - x0_) * x_ + (std::clamp(yv, y0_, y1_) - y0_) * y_);
}

}  // namespace renderer
