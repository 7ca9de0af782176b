#pragma once

#include "numeric/vec.h"
#include "scene/similarity.h"
#include "scene/xml_source.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Reports all errors in the steps of a <transform> (translate, rotate, scale, lookat, matrix),
/// each by itself. Returns true if there are none.
bool check_steps(const XmlElement& transform, SceneErrors& errors);

/// The matrix of a <transform> whose steps were checked; they are applied in document order. The
/// result is affine and invertible; if the steps together are not, throws Error at the element.
/// Points are column vectors; <matrix> is written row by row.
glm::dmat4 parse_transform(const XmlElement& element);

/// Notes on steps of a checked <transform> whose meaning differs from Mitsuba's.
std::vector<std::string> notes_on_steps(const XmlElement& transform);

/// True if the transform mirrors: a counter-clockwise triangle becomes a clockwise one.
bool mirrors(const glm::dmat4& transform);

/// The images of a point and of a direction, in float. Throws Error at `at` when they leave float's
/// range.
Vec3 transform_point(const glm::dmat4& transform, glm::dvec3 p, Position at);
Vec3 transform_vector(const glm::dmat4& transform, glm::dvec3 v, Position at);

/// True if two directions have the same length and are at right angles, within the precision of
/// numbers in scene files (a relative 1e-4).
bool equal_and_orthogonal(glm::dvec3 a, glm::dvec3 b);

/// The similarity equal to an affine transform, its rotation made orthogonal to double precision;
/// nothing if the transform shears or scales directions differently by more than the precision of
/// numbers in scene files.
std::optional<Similarity> similarity(const glm::dmat4& transform);

}  // namespace carlo
