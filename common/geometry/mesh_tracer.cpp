#include "geometry/mesh_tracer.h"

#include "geometry/embree.h"
#include "numeric/robust.h"
#include "support/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace carlo {
namespace {

template <class T>
void copy(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
          const std::vector<T>& values) {
  void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
  if (data == nullptr) throw Error("Embree is out of memory");
  std::memcpy(data, values.data(), values.size() * sizeof(T));
}

RTCRay ray_of(const MeshRays& rays, std::size_t i) {
  RTCRay ray{};
  ray.org_x = rays.ox[i], ray.org_y = rays.oy[i], ray.org_z = rays.oz[i];
  ray.dir_x = rays.dx[i], ray.dir_y = rays.dy[i], ray.dir_z = rays.dz[i];
  ray.tnear = std::numeric_limits<float>::min();
  ray.tfar = rays.t[i];
  ray.mask = ~0u;
  return ray;
}

/// Of two triangles back to back only the one that faces the ray is met. We make only single rays.
void pass_backs(const RTCFilterFunctionNArguments* args) {
  const auto& mesh = *static_cast<const Mesh*>(args->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  if (args->valid[0] == 0 || mesh.back_to_back[hit.primID] == 0) return;
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const glm::uvec3 corner = mesh.triangles[hit.primID];
  const glm::dvec3 a(mesh.positions[corner.x]), b(mesh.positions[corner.y]),
      c(mesh.positions[corner.z]), d(ray.dir_x, ray.dir_y, ray.dir_z);
  if (glm::dot(glm::cross(b - a, c - a), d) > 0) args->valid[0] = 0;
}

}  // namespace

RTCGeometry embree_triangles(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!mesh.back_to_back.empty()) {
    rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
    rtcSetGeometryIntersectFilterFunction(geometry, pass_backs);
  }
  copy(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions);
  copy(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  return geometry;
}

TrianglePoint triangle_point(const Mesh& mesh, std::uint32_t triangle, float u, float v) {
  const glm::uvec3 corner = mesh.triangles[triangle];
  const Vec3 a = mesh.positions[corner.x], b = mesh.positions[corner.y],
             c = mesh.positions[corner.z];
  // In double: a sliver's edges are nearly parallel, and their float cross product is noise.
  using Vec3d = glm::dvec3;
  return {(1 - u - v) * a + u * b + v * c,
          rounding_bound(12) * glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))),
          Vec3(glm::normalize(glm::cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a))))};
}

Vec3 shading_normal(const Mesh& mesh, std::uint32_t triangle, float u, float v, Vec3 n, Vec3 d) {
  if (mesh.normals_of.empty() || mesh.normals_of[triangle].x == Mesh::flat) return n;
  const glm::uvec3 corner = mesh.normals_of[triangle];
  const Vec3 sum = (1 - u - v) * mesh.normals[corner.x] + u * mesh.normals[corner.y] +
                   v * mesh.normals[corner.z];
  const float length = glm::length(sum), side = glm::dot(sum, n);
  if (!(length > 1e-4f) || side == 0) return n;
  const Vec3 smooth = (side > 0 ? 1 / length : -1 / length) * sum;
  return (glm::dot(smooth, d) > 0) == (glm::dot(n, d) > 0) ? smooth : n;
}

TriangleHit triangle_hit(const Mesh& mesh, std::uint32_t triangle, Vec3 o, Vec3 d,
                         const TriangleHit& about) {
  // Source: Moeller, Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of
  // Graphics Tools 2(1), 1997.
  using Vec3d = glm::dvec3;
  const glm::uvec3 corner = mesh.triangles[triangle];
  const Vec3d a = mesh.positions[corner.x], along = d;
  const Vec3d ab = Vec3d(mesh.positions[corner.y]) - a, ac = Vec3d(mesh.positions[corner.z]) - a;
  const Vec3d across = glm::cross(along, ac), from_a = Vec3d(o) - a;
  const double inverse = 1 / glm::dot(ab, across);
  const Vec3d normal = glm::cross(from_a, ab);
  const double t = inverse * glm::dot(ac, normal);
  if (!std::isfinite(t)) return about;
  // A hit may lie outside by the amount that Embree lets neighbours overlap.
  const double u = std::clamp(inverse * glm::dot(from_a, across), 0.0, 1.0);
  const double v = std::clamp(inverse * glm::dot(along, normal), 0.0, 1 - u);
  return {std::max(static_cast<float>(t), std::numeric_limits<float>::min()), static_cast<float>(u),
          static_cast<float>(v)};
}

struct MeshTracer::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Impl() = default;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

MeshTracer::MeshTracer(std::vector<const Mesh*> meshes)
    : meshes_(std::move(meshes)), impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) throw Error("Embree did not start");
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
  for (unsigned i = 0; i < meshes_.size(); ++i) {
    RTCGeometry geometry = embree_triangles(impl_->device, *meshes_[i]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(impl_->scene, geometry, i);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) throw Error("Embree is out of memory");
}

MeshTracer::~MeshTracer() = default;

// Ray by ray: Embree's packets of 16 were no faster on a million triangles.
std::uint32_t MeshTracer::intersect(MeshRays& rays, std::uint32_t wanted) const {
  std::uint32_t met = 0;
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    RTCRayHit query{};
    query.ray = ray_of(rays, i);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(impl_->scene, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const TriangleHit hit = triangle_hit(
        mesh(query.hit.geomID), query.hit.primID, {rays.ox[i], rays.oy[i], rays.oz[i]},
        {rays.dx[i], rays.dy[i], rays.dz[i]}, {query.ray.tfar, query.hit.u, query.hit.v});
    rays.t[i] = hit.t, rays.u[i] = hit.u, rays.v[i] = hit.v;
    rays.mesh[i] = query.hit.geomID, rays.triangle[i] = query.hit.primID;
    met |= std::uint32_t{1} << i;
  }
  return met;
}

std::uint32_t MeshTracer::occluded(const MeshRays& rays, std::uint32_t wanted) const {
  std::uint32_t blocked = 0;
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    RTCRay query = ray_of(rays, i);
    embree_occluded(impl_->scene, &query);
    if (query.tfar < 0) blocked |= std::uint32_t{1} << i;
  }
  return blocked;
}

}  // namespace carlo
