#pragma once

#include "scene/scene.h"
#include "scene/xml_source.h"

namespace carlo {

/// Leaves out lamps of a scene that lie where another one lies, to the rounding of their corners,
/// and face the same way: parallelograms, spheres, disks, and triangles of meshes, which may be
/// half of a parallelogram. A ray meets one of them, but light would come from both. A note says
/// how many. Throws Error `at` if the two differ in radiance or material.
void leave_out_duplicate_lamps(Scene& scene, Position at);

}  // namespace carlo
