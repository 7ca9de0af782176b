#pragma once

#include "numeric/vec.h"
#include "scene/xml_source.h"

namespace carlo {

/// Tells of all that is wrong with the steps of a <transform> (translate, rotate, scale, lookat,
/// matrix), each by itself. Whether nothing is.
bool check_steps(const XmlElement& transform, SceneErrors& errors);

/// The matrix of a <transform> whose steps were checked: they are applied in the order in which
/// they stand. It is affine and invertible; Error at the element if all of them together are not.
/// Points are column vectors; <matrix> is written row by row.
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
