#pragma once

// A common interface to Embree 3 and 4. Embree 4 moved a query's context into its arguments, and
// took the ray out of the callbacks' context.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define CARLO_EMBREE 4
#else
#include <embree3/rtcore.h>
#define CARLO_EMBREE 3
#endif

namespace carlo {

struct Mesh;

/// Makes an Embree geometry of the mesh; not committed. Throws Error if out of memory.
RTCGeometry embree_triangles(RTCDevice device, const Mesh& mesh);

inline void embree_intersect(RTCScene scene, RTCRayHit* query) {
#if CARLO_EMBREE == 4
  rtcIntersect1(scene, query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, query);
#endif
}

inline void embree_occluded(RTCScene scene, RTCRay* ray) {
#if CARLO_EMBREE == 4
  rtcOccluded1(scene, ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, ray);
#endif
}

}  // namespace carlo
