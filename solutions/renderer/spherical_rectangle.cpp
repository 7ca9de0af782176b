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
      x(glm::normalize(rectangle.u)),
      y(glm::normalize(rectangle.v)),
      z(glm::cross(x, y)),
      width(static_cast<double>(glm::length(rectangle.u))),
      height(static_cast<double>(glm::length(rectangle.v))) {}

SphericalRectangle::SphericalRectangle(const RectangleFrame& rectangle, Vec3 from)
    : origin_(rectangle.origin), x_(rectangle.x), y_(rectangle.y) {
  const Vec3 d = rectangle.origin - from;
  x0_ = glm::dot(d, x_);
  y0_ = glm::dot(d, y_);
  z0_ = glm::dot(d, rectangle.z);
  // The local z axis points away from the rectangle.
  z0_ = -std::abs(z0_);
  x1_ = x0_ + rectangle.width;
  y1_ = y0_ + rectangle.height;
  // The z components of the normals of the four planes through `from` and an edge. The solid angle
  // is the sum of the angles between neighbouring planes, less 2 pi: in float that difference
  // would lose a distant rectangle, hence double throughout.
  const double z2 = square(z0_);
  const double n0 = -y0_ / std::sqrt(z2 + square(y0_)), n1 = x1_ / std::sqrt(z2 + square(x1_)),
               n2 = y1_ / std::sqrt(z2 + square(y1_)), n3 = -x0_ / std::sqrt(z2 + square(x0_));
  const double g0 = std::acos(std::clamp(-n0 * n1, -1.0, 1.0)),
               g1 = std::acos(std::clamp(-n1 * n2, -1.0, 1.0)),
               g2 = std::acos(std::clamp(-n2 * n3, -1.0, 1.0)),
               g3 = std::acos(std::clamp(-n3 * n0, -1.0, 1.0));
  b0_ = n0;
  b1_ = n2;
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
  // ... and along that slice's line, height is uniform on the sphere.
  const double d = std::sqrt(square(xu) + square(z0_));
  const double h0 = y0_ / std::sqrt(square(d) + square(y0_)),
               h1 = y1_ / std::sqrt(square(d) + square(y1_));
  const double h = h0 + static_cast<double>(u.y) * (h1 - h0), h2 = square(h);
  const double yv = h2 < 1 - 1e-12 ? h * d / std::sqrt(1 - h2) : y1_;
  // From the rectangle's own corner: the point keeps the accuracy of its plane, however far `from`
  // is.
  return origin_ + static_cast<float>(xu - x0_) * x_ +
         static_cast<float>(std::clamp(yv, y0_, y1_) - y0_) * y_;
}

}  // namespace renderer
