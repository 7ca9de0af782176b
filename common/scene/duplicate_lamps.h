#pragma once

#include "scene/scene.h"
#include "scene/xml_source.h"

namespace carlo {

/// Leaves out lamps that coincide with another lamp, up to the rounding of their corners, and face
/// the same way: parallelograms, spheres, disks, and triangles of meshes, which may be half of a
/// parallelogram. A ray meets only one of them, but both would give light. A note says how many.
/// Throws Error `at` if the two differ in radiance or material.
void leave_out_duplicate_lamps(Scene& scene, Position at);

}  // namespace carlo
