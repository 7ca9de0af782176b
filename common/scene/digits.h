#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace carlo {

/// Returns a note if floats have too few digits for a scene. A parallelogram that is not parallel
/// to a coordinate plane is placed to 2^-24 of its corners' coordinates. Reports the nearest thing
/// that lies less than a thousand times that error away from the plane, or, if it touches the
/// plane, whose size is less: in the image it may be displaced by a thousandth of that or more.
/// Looks at parallelograms, spheres, disks and point lights, not at meshes, whose triangles are
/// many and Embree's, and not at scenes of more than 3000 shapes.
std::optional<std::string> too_few_digits(const Scene& scene);

}  // namespace carlo
