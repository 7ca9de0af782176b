#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace carlo {

/// A note if floats have too few digits for a scene. A parallelogram that is not parallel to a
/// coordinate plane has its place to 2^-24 of its corners' coordinates. Told of is, of what is
/// nearest for its plane's digits, that it lies less than a thousand times that away, or, if it
/// touches the plane, that its size is less: in the image it may lie, or end, a thousandth of that
/// elsewhere. Looks at parallelograms, spheres, disks and point lights, not at meshes, whose
/// triangles are many and Embree's, and not at scenes of more than 3000 shapes.
std::optional<std::string> too_few_digits(const Scene& scene);

}  // namespace carlo
