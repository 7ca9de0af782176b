#pragma once

#include "scene/scene.h"
#include "scene/xml_source.h"

namespace carlo {

/// Leaves out lights that coincide with another light, up to the rounding of their corners, and
/// face the same way: parallelograms, spheres, disks, and triangles of meshes, which may be half of
/// a parallelogram. A ray meets only one of them, but both would give light. A note says how many.
/// Throws Error `at` if the two differ in radiance or material.
void leave_out_duplicate_lights(Scene& scene, Position at);

}  // namespace carlo
