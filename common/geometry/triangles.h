#pragma once

#include "geometry/embree.h"
#include "geometry/mesh_tracer.h"
#include "scene/scene.h"

namespace carlo {

/// The mesh as Embree's; not committed. Throws Error if memory is short.
RTCGeometry embree_triangles(RTCDevice device, const Mesh& mesh);

}  // namespace carlo
