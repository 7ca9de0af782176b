#include "geometry/mesh_tracer.h"

#include "geometry/embree.h"
#include "numeric/robust.h"
#include "support/error.h"

#include <algorithm>
#include <array>
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

/// Which rays of a packet are wanted, as Embree takes it.
struct alignas(64) Valid : std::array<int, MeshRays::most> {
  explicit Valid(std::uint32_t wanted) {
    for (std::size_t i = 0; i < size(); ++i)
      (*this)[i] = -static_cast<int>(wanted >> i & 1);
  }
};

template <class T>
void copy(const MeshRays::Column<T>& from, T* to) {
  std::memcpy(to, from.data(), sizeof from);
}

/// Rays that are not wanted get an empty segment: without AVX-512, Embree 3.13 traces every ray of
/// a packet that has one, whatever `valid` says. Their numbers may be anything, and Debian's
/// Embree, whose assertions are on, ends the program at one that is not finite.
void fill(RTCRay16& packet, const MeshRays& rays, std::uint32_t wanted) {
  copy(rays.ox, packet.org_x), copy(rays.oy, packet.org_y), copy(rays.oz, packet.org_z);
  copy(rays.dx, packet.dir_x), copy(rays.dy, packet.dir_y), copy(rays.dz, packet.dir_z);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < MeshRays::most; ++i) {
    const bool is_wanted = (wanted >> i & 1) != 0;
    packet.tnear[i] = is_wanted ? std::numeric_limits<float>::min() : infinity;
    packet.tfar[i] = is_wanted ? rays.t[i] : -infinity;
  }
  std::fill_n(packet.time, MeshRays::most, 0.0f);
  std::fill_n(packet.mask, MeshRays::most, ~0u);
  std::fill_n(packet.flags, MeshRays::most, 0u);
}

/// embree_intersect() for the rays of a packet with valid[i] = -1.
void intersect_packet(const int* valid, RTCScene scene, RTCRayHit16* queries) {
#if CARLO_EMBREE == 4
  rtcIntersect16(valid, scene, queries);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect16(valid, scene, &context, queries);
#endif
}

void occlude_packet(const int* valid, RTCScene scene, RTCRay16* rays) {
#if CARLO_EMBREE == 4
  rtcOccluded16(valid, scene, rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, rays);
#endif
}

/// Of two triangles back to back only the one that faces the ray is met.
void pass_backs(const RTCFilterFunctionNArguments* args) {
  const auto& mesh = *static_cast<const Mesh*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    if (args->valid[i] == 0 || mesh.back_to_back[triangle] == 0) continue;
    const glm::dvec3 d(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                       RTCRayN_dir_z(args->ray, args->N, i));
    const glm::uvec3 corner = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corner.x]), b(mesh.positions[corner.y]),
        c(mesh.positions[corner.z]);
    if (glm::dot(glm::cross(b - a, c - a), d) > 0) args->valid[i] = 0;
  }
}

/// Reads ahead what triangle_hit() and shading_normal() will need of a triangle.
void prefetch_corners(const Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3 corner = mesh.triangles[triangle];
  for (int k = 0; k < 3; ++k)
    __builtin_prefetch(&mesh.positions[corner[k]]);
  if (mesh.normals_of.empty() || mesh.normals_of[triangle].x == Mesh::flat) return;
  const glm::uvec3 normal = mesh.normals_of[triangle];
  for (int k = 0; k < 3; ++k)
    __builtin_prefetch(&mesh.normals[normal[k]]);
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

MeshTracer::MeshTracer(std::vector<const Mesh*> meshes, const char* embree)
    : meshes_(std::move(meshes)), impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(embree);
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

// Triangles are rarely in the cache, so they are read ahead in steps: no read waits for another.
std::uint32_t MeshTracer::intersect(MeshRays& rays, std::uint32_t wanted) const {
  alignas(64) RTCRayHit16 queries;
  fill(queries.ray, rays, wanted);
  std::fill_n(queries.hit.geomID, MeshRays::most, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(queries.hit.instID[0], MeshRays::most, RTC_INVALID_GEOMETRY_ID);
  intersect_packet(Valid(wanted).data(), impl_->scene, &queries);
  std::uint32_t met = 0;
  const auto for_met = [&](const auto& f) {
    for (std::uint32_t left = met; left != 0; left &= left - 1)
      f(static_cast<std::size_t>(std::countr_zero(left)));
  };
  for (std::size_t i = 0; i < MeshRays::most; ++i) {
    const bool hit = (wanted >> i & 1) != 0 && queries.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    met |= static_cast<std::uint32_t>(hit) << i;
  }
  for_met([&](std::size_t i) {
    const Mesh& of = mesh(queries.hit.geomID[i]);
    rays.mesh[i] = queries.hit.geomID[i], rays.triangle[i] = queries.hit.primID[i];
    __builtin_prefetch(&of.triangles[rays.triangle[i]]);
    if (!of.normals_of.empty()) __builtin_prefetch(&of.normals_of[rays.triangle[i]]);
  });
  for_met([&](std::size_t i) { prefetch_corners(mesh(rays.mesh[i]), rays.triangle[i]); });
  for_met([&](std::size_t i) {
    const TriangleHit hit =
        triangle_hit(mesh(rays.mesh[i]), rays.triangle[i], {rays.ox[i], rays.oy[i], rays.oz[i]},
                     {rays.dx[i], rays.dy[i], rays.dz[i]},
                     {queries.ray.tfar[i], queries.hit.u[i], queries.hit.v[i]});
    rays.t[i] = hit.t, rays.u[i] = hit.u, rays.v[i] = hit.v;
  });
  return met;
}

std::uint32_t MeshTracer::occluded(const MeshRays& rays, std::uint32_t wanted) const {
  alignas(64) RTCRay16 queries;
  fill(queries, rays, wanted);
  occlude_packet(Valid(wanted).data(), impl_->scene, &queries);
  std::uint32_t blocked = 0;
  for (std::size_t i = 0; i < MeshRays::most; ++i)
    blocked |= static_cast<std::uint32_t>((wanted >> i & 1) != 0 && queries.tfar[i] < 0) << i;
  return blocked;
}

}  // namespace carlo
