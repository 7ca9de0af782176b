#pragma once

#include "numeric/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Whether the triangles (0, i - 1, i) are a polygon: so it is for convex ones, and for those all
/// of which their first corner sees. Also true for polygons that have no area but that of rounding:
/// it is not worth a refusal.
bool fan_fits(const std::vector<glm::dvec3>& points);

/// Cuts a polygon into points.size() - 2 triangles of its orientation, by its corners' numbers. One
/// that is not flat is cut as it is seen along its normal (its vector area). It may touch itself,
/// as where a cut leads to a hole; if its edges cross, or if it has too many corners, the answer is
/// what is wrong.
std::optional<std::string> cut_into_triangles(const std::vector<glm::dvec3>& points,
                                              std::vector<glm::uvec3>& triangles);

}  // namespace carlo
