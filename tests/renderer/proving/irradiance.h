#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace proving {

/// The irradiance at the origin, normal +y, from a polygon of radiance 1 entirely above the plane y
/// = 0, whichever way it faces. Lambert's formula: half the sum over edges of the angle that the
/// edge subtends times the cosine between +y and the normal of the edge's plane.
double polygon_irradiance(const std::vector<glm::dvec3>& corners);

/// The solid angle of the rectangle [-a, a] x [-b, b] seen from the height h above its centre.
double rectangle_solid_angle(double a, double b, double h);

}  // namespace proving
