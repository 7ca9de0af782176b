#pragma once

#include "scene/scene.h"

#include <optional>

namespace carlo {

/// The diagonal of the box around all shapes, lamps and the camera of a scene.
double diameter(const Scene& scene);

/// The middle of all shapes, lamps and the camera of a scene whose coordinates lose digits by where
/// it lies: if that is more than eight times their extent away from the origin. Nothing otherwise.
std::optional<glm::dvec3> far_center(const Scene& scene);

}  // namespace carlo
