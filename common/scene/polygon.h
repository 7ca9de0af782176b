#pragma once

#include "numeric/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// True if the triangles (0, i - 1, i) make up the polygon: for convex polygons, and for those that
/// are entirely visible from their first corner. Also true for polygons without area up to
/// rounding, which are not worth a refusal.
bool fan_fits(const std::vector<glm::dvec3>& points);

/// Cuts a polygon into points.size() - 2 triangles of its orientation, given by the numbers of its
/// corners. A polygon that is not flat is cut as seen along its normal (its vector area). It may
/// touch itself, as where a cut leads to a hole; if its edges cross, or it has too many corners,
/// returns what is wrong.
std::optional<std::string> cut_into_triangles(const std::vector<glm::dvec3>& points,
                                              std::vector<glm::uvec3>& triangles);

}  // namespace carlo
