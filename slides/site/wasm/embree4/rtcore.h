#pragma once

// The part of Embree 4 that common/geometry uses for parallelograms, spheres, disks and signed
// distance functions, for WebAssembly, which Debian's Embree is not built for: each ray is tried
// against the box of every primitive. Triangles are left out.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

struct RTCRay {
  float org_x, org_y, org_z, tnear;
  float dir_x, dir_y, dir_z, time;
  float tfar;
  unsigned mask, id, flags;
};
struct RTCHit {
  float Ng_x, Ng_y, Ng_z, u, v;
  unsigned primID, geomID, instID[1];
};
struct RTCRayHit {
  RTCRay ray;
  RTCHit hit;
};
struct RTCBounds {
  float lower_x, lower_y, lower_z, align0, upper_x, upper_y, upper_z, align1;
};
struct RTCRayN;
struct RTCRayHitN;

struct RTCIntersectFunctionNArguments {
  int* valid;
  void* geometryUserPtr;
  unsigned primID;
  RTCRayHitN* rayhit;
  unsigned geomID;
};
struct RTCOccludedFunctionNArguments {
  int* valid;
  void* geometryUserPtr;
  unsigned primID;
  RTCRayN* ray;
  unsigned geomID;
};
struct RTCBoundsFunctionArguments {
  void* geometryUserPtr;
  unsigned primID;
  RTCBounds* bounds_o;
};
using RTCBoundsFunction = void (*)(const RTCBoundsFunctionArguments*);
using RTCIntersectFunctionN = void (*)(const RTCIntersectFunctionNArguments*);
using RTCOccludedFunctionN = void (*)(const RTCOccludedFunctionNArguments*);

struct CarloGeometry {
  unsigned count = 0, id = 0;
  void* user = nullptr;
  RTCBoundsFunction bounds = nullptr;
  RTCIntersectFunctionN intersect = nullptr;
  RTCOccludedFunctionN occluded = nullptr;
};
struct CarloPrimitive {
  CarloGeometry* geometry;
  unsigned primitive;
  RTCBounds box;
};
struct CarloScene {
  std::vector<std::unique_ptr<CarloGeometry>> geometries;
  std::vector<CarloPrimitive> primitives;
};

using RTCDevice = void*;
using RTCScene = CarloScene*;
using RTCGeometry = CarloGeometry*;
enum RTCGeometryType { RTC_GEOMETRY_TYPE_USER };
enum RTCSceneFlags { RTC_SCENE_FLAG_ROBUST };
enum RTCBuildQuality { RTC_BUILD_QUALITY_HIGH };
enum RTCError { RTC_ERROR_NONE };
constexpr unsigned RTC_INVALID_GEOMETRY_ID = ~0u;

inline RTCDevice rtcNewDevice(const char*) {
  static int device;
  return &device;
}
inline void rtcReleaseDevice(RTCDevice) {}
inline RTCError rtcGetDeviceError(RTCDevice) {
  return RTC_ERROR_NONE;
}
inline RTCScene rtcNewScene(RTCDevice) {
  return new CarloScene;
}
inline void rtcReleaseScene(RTCScene scene) {
  delete scene;
}
inline void rtcSetSceneFlags(RTCScene, RTCSceneFlags) {}
inline void rtcSetSceneBuildQuality(RTCScene, RTCBuildQuality) {}

inline RTCGeometry rtcNewGeometry(RTCDevice, RTCGeometryType) {
  return new CarloGeometry;
}
inline void rtcSetGeometryUserPrimitiveCount(RTCGeometry geometry, unsigned count) {
  geometry->count = count;
}
inline void rtcSetGeometryUserData(RTCGeometry geometry, void* user) {
  geometry->user = user;
}
inline void rtcSetGeometryBoundsFunction(RTCGeometry geometry, RTCBoundsFunction f, void*) {
  geometry->bounds = f;
}
inline void rtcSetGeometryIntersectFunction(RTCGeometry geometry, RTCIntersectFunctionN f) {
  geometry->intersect = f;
}
inline void rtcSetGeometryOccludedFunction(RTCGeometry geometry, RTCOccludedFunctionN f) {
  geometry->occluded = f;
}
inline void rtcCommitGeometry(RTCGeometry) {}
inline void rtcReleaseGeometry(RTCGeometry) {}
inline void rtcAttachGeometryByID(RTCScene scene, RTCGeometry geometry, unsigned id) {
  geometry->id = id;
  scene->geometries.emplace_back(geometry);
}

inline void rtcCommitScene(RTCScene scene) {
  for (const auto& geometry : scene->geometries) {
    for (unsigned i = 0; i < geometry->count; ++i) {
      CarloPrimitive primitive{geometry.get(), i, {}};
      const RTCBoundsFunctionArguments args{geometry->user, i, &primitive.box};
      geometry->bounds(&args);
      scene->primitives.push_back(primitive);
    }
  }
}

/// Where a ray is within a slab, narrowed by half an ulp or so too little rather than too much.
inline void carlo_clip(float lower, float upper, float o, float inverse, float& from, float& to) {
  const float a = (lower - o) * inverse, b = (upper - o) * inverse;
  // A NaN, 0 times infinity on the edge of a slab, leaves the range as it is.
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
}

/// Calls visit(primitive) for those whose boxes the ray meets, until it returns true.
template <class Visit>
void carlo_visit(RTCScene scene, const RTCRay& ray, const Visit& visit) {
  const float x = 1 / ray.dir_x, y = 1 / ray.dir_y, z = 1 / ray.dir_z;
  for (const CarloPrimitive& one : scene->primitives) {
    float from = 0, to = ray.tfar;
    carlo_clip(one.box.lower_x, one.box.upper_x, ray.org_x, x, from, to);
    carlo_clip(one.box.lower_y, one.box.upper_y, ray.org_y, y, from, to);
    carlo_clip(one.box.lower_z, one.box.upper_z, ray.org_z, z, from, to);
    if (from <= to * 1.000001f && visit(one)) return;
  }
}

inline void rtcIntersect1(RTCScene scene, RTCRayHit* query) {
  int valid = -1;
  carlo_visit(scene, query->ray, [&](const CarloPrimitive& one) {
    const RTCIntersectFunctionNArguments args{&valid, one.geometry->user, one.primitive,
                                              reinterpret_cast<RTCRayHitN*>(query),
                                              one.geometry->id};
    one.geometry->intersect(&args);
    return false;
  });
}

inline void rtcOccluded1(RTCScene scene, RTCRay* ray) {
  int valid = -1;
  carlo_visit(scene, *ray, [&](const CarloPrimitive& one) {
    const RTCOccludedFunctionNArguments args{&valid, one.geometry->user, one.primitive,
                                             reinterpret_cast<RTCRayN*>(ray), one.geometry->id};
    one.geometry->occluded(&args);
    return ray->tfar < 0;
  });
}
