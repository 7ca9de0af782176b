#pragma once

#include <glm/glm.hpp>

namespace carlo {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
/// Linear RGB: radiance (W m^-2 sr^-1 in the scene's units), reflectance or throughput.
using Rgb = glm::vec3;
using Mat4 = glm::mat4;

}  // namespace carlo
