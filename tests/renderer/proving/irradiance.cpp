#include "proving/irradiance.h"

#include <cmath>
#include <cstddef>

namespace proving {

double polygon_irradiance(const std::vector<glm::dvec3>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
    const glm::dvec3 normal = glm::cross(a, b);
    const double length = glm::length(normal);
    if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * normal.y / length;
  }
  return std::abs(sum) / 2;
}

double rectangle_solid_angle(double a, double b, double h) {
  return 4 * std::atan2(a * b, h * std::sqrt(a * a + b * b + h * h));
}

}  // namespace proving
