#pragma once

#include "scene/scene.h"

#include <optional>

namespace carlo {

/// The diagonal of the box around all shapes, lights and the camera of a scene.
double diameter(const Scene& scene);

/// The middle of all shapes, lights and the camera, if the scene is so far from the origin that its
/// coordinates lose digits: more than eight times its extent. Nothing otherwise.
std::optional<glm::dvec3> far_center(const Scene& scene);

}  // namespace carlo
