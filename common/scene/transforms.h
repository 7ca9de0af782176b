#pragma once

#include "numeric/vec.h"
#include "scene/xml_source.h"

namespace carlo {

/// The matrix of a <transform>: its steps (translate, rotate, scale, lookat, matrix) are applied in
/// the order in which they stand. It is affine, finite and invertible; anything else is an Error at
/// the step at fault. Points are column vectors; <matrix> is written row by row.
glm::dmat4 parse_transform(const XmlElement& element);

/// Whether the transform mirrors: a counter-clockwise triangle becomes a clockwise one.
bool mirrors(const glm::dmat4& transform);

/// The images of a point and of a direction, in float. Throws Error at `at` when they leave float's
/// range.
Vec3 transform_point(const glm::dmat4& transform, glm::dvec3 p, Position at);
Vec3 transform_vector(const glm::dmat4& transform, glm::dvec3 v, Position at);

/// Whether two directions have the same length and are at right angles, within the precision that
/// numbers have in scene files (a relative 1e-4).
bool equal_and_orthogonal(glm::dvec3 a, glm::dvec3 b);

}  // namespace carlo
