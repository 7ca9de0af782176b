#include "geometry/intersector.h"

#include "geometry/analytic.h"
#include "geometry/embree.h"
#include "geometry/mesh_tracer.h"
#include "geometry/planes.h"
#include "geometry/sphere_tracer.h"
#include "numeric/robust.h"
#include "scene/match.h"
#include "support/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace carlo {
namespace {

template <class S>
struct Primitive {
  const S* surface;
  std::uint32_t shape;
  std::uint32_t plane;  ///< the first shape in a parallelogram's plane; of others, their own number
};

/// A parallelogram and the others of its plane.
struct Flat {
  Quad quad;
  std::uint32_t shape;
  Vec3 lower, upper;  ///< its bounds
  /// All parallelograms of its plane, if there are others, and how far apart they may be.
  std::vector<std::uint32_t> coplanar;
  Vec3 gap{0};

  Flat(const Parallelogram& s, std::uint32_t index) : quad(s), shape(index) {
    lower = glm::min(glm::min(s.origin, s.origin + s.u),
                     glm::min(s.origin + s.v, s.origin + s.u + s.v));
    upper = glm::max(glm::max(s.origin, s.origin + s.u),
                     glm::max(s.origin + s.v, s.origin + s.u + s.v));
    const Vec3 margin = rounding_bound(8) * (glm::abs(s.origin) + glm::abs(s.u) + glm::abs(s.v));
    lower -= margin;
    upper += margin;
  }
};

/// Callbacks for surfaces that Embree does not know. Embree calls them only for single rays, since
/// we make no others. The part of the distance that tfar loses by rounding to float is passed in
/// the hit's u.
template <class S, double (*meet)(const S&, Vec3, Vec3, float, float)>
struct UserGeometry {
  static const S& surface(const void* user, unsigned primitive) {
    return *(*static_cast<const std::vector<Primitive<S>>*>(user))[primitive].surface;
  }

  static std::uint32_t plane(const void* user, unsigned primitive) {
    return (*static_cast<const std::vector<Primitive<S>>*>(user))[primitive].plane;
  }

  static double find(const RTCRay& ray, const S& s) {
    return meet(s, {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear,
                ray.tfar);
  }

  static void intersect(const RTCIntersectFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto* query = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const double t = find(query->ray, surface(args->geometryUserPtr, args->primID));
    if (t < 0) return;
    query->ray.tfar = static_cast<float>(t);
    query->hit.u = static_cast<float>(t - static_cast<double>(query->ray.tfar));
    query->hit.geomID = args->geomID;
    query->hit.primID = args->primID;
    query->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }

  static void occluded(const RTCOccludedFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto* ray = reinterpret_cast<RTCRay*>(args->ray);
    if (ray->id == plane(args->geometryUserPtr, args->primID)) return;
    if (find(*ray, surface(args->geometryUserPtr, args->primID)) >= 0) {
      ray->tfar = -std::numeric_limits<float>::infinity();
    }
  }
};

double intersect_flat(const Flat& flat, Vec3 o, Vec3 d, float tnear, float tfar) {
  return intersect_quad(flat.quad, o, d, tnear, tfar);
}

double intersect_sdf(const SphereTracer& tracer, Vec3 o, Vec3 d, float tnear, float tfar) {
  return tracer.intersect(o, d, tnear, tfar);
}

/// The half-extent of a surface's bounds, without rounding.
Vec3 half_extent(const Sphere& sphere) {
  return Vec3(sphere.radius);
}
Vec3 half_extent(const Disk& disk) {
  return disk.radius * glm::sqrt(glm::max(Vec3(0), 1.0f - disk.normal * disk.normal));
}

struct Bounds {
  Vec3 lower, upper;
};

template <class S>
Bounds bounds_of(const S& s) {
  const Vec3 half = half_extent(s) + (glm::abs(s.center) + Vec3(s.radius)) * rounding_bound(8);
  return {s.center - half, s.center + half};
}
Bounds bounds_of(const SphereTracer& tracer) {
  return {tracer.lower(), tracer.upper()};
}

Bounds bounds_of(const Flat& flat) {
  return {flat.lower, flat.upper};
}

template <class S>
void bounds(const RTCBoundsFunctionArguments* args) {
  const auto& primitives = *static_cast<const std::vector<Primitive<S>>*>(args->geometryUserPtr);
  const auto [lower, upper] = bounds_of(*primitives[args->primID].surface);
  *args->bounds_o = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, 0};
}

RTCRay embree_ray(const Ray& ray, float tmax) {
  RTCRay r{};
  r.org_x = ray.o.x;
  r.org_y = ray.o.y;
  r.org_z = ray.o.z;
  r.dir_x = ray.d.x;
  r.dir_y = ray.d.y;
  r.dir_z = ray.d.z;
  // Embree accepts t = tnear. A surface in a coordinate plane has no rounding error, so a ray may
  // start exactly on it, at t = 0; that is not a hit.
  r.tnear = std::numeric_limits<float>::min();
  r.tfar = tmax;
  r.mask = ~0u;
  return r;
}

}  // namespace

struct Intersector::Impl {
  const Scene& scene;
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;
  std::vector<Flat> flats;
  std::vector<Primitive<Flat>> parallelograms;
  std::vector<Primitive<Sphere>> spheres;
  std::vector<Primitive<Disk>> disks;
  std::vector<SphereTracer> tracers;
  std::vector<Primitive<SphereTracer>> sdfs;
  std::vector<Primitive<Mesh>> meshes;
  std::vector<std::uint32_t> plane_of;  ///< of each shape, Primitive::plane
  std::size_t added = 0;                ///< shapes that Embree knows

  explicit Impl(const Scene& s) : scene(s) {
    // No "threads=1" here: it would limit TBB in the whole program.
    device = rtcNewDevice(nullptr);
    if (device == nullptr) throw Error("Embree did not start");
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_HIGH);
    sort_shapes();
    for (unsigned kind = 0; kind <= first_mesh; ++kind)
      add_all(static_cast<Kind>(kind));
    if (added != scene.shapes.size()) {
      throw Error("rays would not meet {} of {} shapes", scene.shapes.size() - added,
                  scene.shapes.size());
    }
    rtcCommitScene(embree);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw Error("Embree is out of memory");
  }

  ~Impl() {
    if (embree != nullptr) rtcReleaseScene(embree);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Embree's geometry numbers: one for each kind of shape that shares a geometry, then one for
  /// each mesh.
  enum class Kind : unsigned { parallelograms, spheres, disks, sdfs, meshes };
  static constexpr auto first_mesh = static_cast<unsigned>(Kind::meshes);

  void sort_shapes() {
    std::vector<std::uint32_t> sdf_shapes;
    std::vector<Parallelogram> surfaces;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
      match(
          scene.shapes[i].geometry,
          [&](const Parallelogram& quad) {
            flats.emplace_back(quad, i);
            surfaces.push_back(quad);
          },
          [&](const Sphere& sphere) {
            spheres.push_back({&sphere, i, i});
          },
          [&](const Disk& disk) {
            disks.push_back({&disk, i, i});
          },
          [&](const Mesh& mesh) {
            meshes.push_back({&mesh, i, i});
          },
          [&](const Sdf& sdf) {
            tracers.emplace_back(sdf);
            sdf_shapes.push_back(i);
          });
    }
    for (std::size_t i = 0; i < tracers.size(); ++i)
      sdfs.push_back({&tracers[i], sdf_shapes[i], sdf_shapes[i]});
    const Planes planes = find_planes(surfaces);
    set_planes(planes);
    plane_of.resize(scene.shapes.size());
    std::iota(plane_of.begin(), plane_of.end(), 0u);
    for (std::size_t i = 0; i < flats.size(); ++i) {
      plane_of[flats[i].shape] = flats[planes.of[i].first].shape;
      parallelograms.push_back({&flats[i], flats[i].shape, plane_of[flats[i].shape]});
    }
  }

  /// Makes rays that leave a parallelogram start beyond all others in its plane.
  void set_planes(const Planes& planes) {
    std::vector<std::vector<std::uint32_t>> members(flats.size());
    for (std::uint32_t i = 0; i < flats.size(); ++i)
      members[planes.of[i].first].push_back(i);
    for (const auto& together : members) {
      if (together.size() < 2) continue;
      float gap = 0;
      for (const std::uint32_t i : together)
        gap = std::max(gap, static_cast<float>(2 * planes.of[i].gap));
      for (const std::uint32_t i : together) {
        flats[i].coplanar = together;
        flats[i].gap = gap * glm::abs(Vec3(flats[i].quad.n));
      }
    }
  }

  /// Among the parallelograms of one plane that lie at p, one whose front the ray meets, if there
  /// is one: which of them Embree reports is chance.
  const Flat& facing(const Flat& met, Vec3 p, Vec3 d) const {
    const auto fronts = [d](const Flat& flat) { return glm::dot(Vec3(flat.quad.n), d) < 0; };
    if (fronts(met)) return met;
    for (const std::uint32_t i : met.coplanar) {
      if (fronts(flats[i]) && flats[i].quad.holds(glm::dvec3(p))) return flats[i];
    }
    return met;
  }

  void add_all(Kind kind) {
    switch (kind) {
      case Kind::parallelograms:
        return add_user<UserGeometry<Flat, intersect_flat>>(parallelograms, kind);
      case Kind::spheres:
        return add_user<UserGeometry<Sphere, intersect_sphere>>(spheres, kind);
      case Kind::disks:
        return add_user<UserGeometry<Disk, intersect_disk>>(disks, kind);
      case Kind::sdfs:
        return add_user<UserGeometry<SphereTracer, intersect_sdf>>(sdfs, kind);
      case Kind::meshes:
        for (std::size_t i = 0; i < meshes.size(); ++i)
          add_mesh(i);
    }
  }

  void attach(RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  template <class Callbacks, class S>
  void add_user(std::vector<Primitive<S>>& primitives, Kind kind) {
    if (primitives.empty()) return;
    added += primitives.size();
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives.size()));
    rtcSetGeometryUserData(geometry, &primitives);
    rtcSetGeometryBoundsFunction(geometry, bounds<S>, nullptr);
    rtcSetGeometryIntersectFunction(geometry, Callbacks::intersect);
    rtcSetGeometryOccludedFunction(geometry, Callbacks::occluded);
    attach(geometry, static_cast<unsigned>(kind));
  }

  void add_mesh(std::size_t i) {
    ++added;
    attach(embree_triangles(device, *meshes[i].surface), first_mesh + static_cast<unsigned>(i));
  }

  void fill(const RTCRayHit& query, const Ray& ray, Hit& hit) const;
  void fill_quad(const Flat& met, const Ray& ray, double t, Hit& hit) const;
};

namespace {

/// For a point that was rounded from double to float once. The error of double is relative to the
/// surface's coordinates and size: where a coordinate of p is about 0, it is the whole error.
void fill_analytic(const SurfacePoint& point, Vec3 coordinates, Hit& hit) {
  hit.p = point.p;
  hit.p_error = rounding_bound(3) * glm::abs(point.p) +
                Vec3(0x1p-49f *
                     (std::abs(coordinates.x) + std::abs(coordinates.y) + std::abs(coordinates.z)));
  hit.n = hit.ns = point.n;
}

/// For a sphere or a disk.
template <class S>
Vec3 coordinates_of(const S& s) {
  return glm::abs(s.center) + Vec3(s.radius);
}

void fill_sdf(const SphereTracer::Point& point, Hit& hit) {
  hit.p = point.p;
  hit.p_error = point.p_error;
  hit.n = hit.ns = point.n;
}

}  // namespace

void Intersector::Impl::fill_quad(const Flat& met, const Ray& ray, double t, Hit& hit) const {
  const Vec3 p = quad_point(met.quad, ray.o, ray.d, t).p;
  const Flat& flat = met.coplanar.empty() ? met : facing(met, p, ray.d);
  hit.shape = flat.shape;
  fill_analytic({p, Vec3(flat.quad.n)}, glm::max(glm::abs(flat.lower), glm::abs(flat.upper)), hit);
  hit.p_error += flat.gap;
}

void Intersector::Impl::fill(const RTCRayHit& query, const Ray& ray, Hit& hit) const {
  const unsigned id = query.hit.geomID, primitive = query.hit.primID;
  hit.t = query.ray.tfar;
  hit.primitive = 0;
  // The part that tfar lost by rounding (UserGeometry).
  const double exact_t = static_cast<double>(hit.t) + static_cast<double>(query.hit.u);
  switch (static_cast<Kind>(id)) {
    case Kind::parallelograms:
      fill_quad(flats[primitive], ray, exact_t, hit);
      return;
    case Kind::spheres:
      hit.shape = spheres[primitive].shape;
      fill_analytic(sphere_point(*spheres[primitive].surface, ray.o, ray.d, hit.t),
                    coordinates_of(*spheres[primitive].surface), hit);
      return;
    case Kind::disks:
      hit.shape = disks[primitive].shape;
      fill_analytic(disk_point(*disks[primitive].surface, ray.o, ray.d, hit.t),
                    coordinates_of(*disks[primitive].surface), hit);
      return;
    case Kind::sdfs:
      hit.shape = sdfs[primitive].shape;
      fill_sdf(sdfs[primitive].surface->point(ray.o, ray.d, exact_t), hit);
      return;
    case Kind::meshes:
      break;
  }
  // All numbers from here on are meshes.
  const Primitive<Mesh>& mesh = meshes[id - first_mesh];
  hit.shape = mesh.shape;
  hit.primitive = primitive;
  const TriangleHit met = triangle_hit(*mesh.surface, primitive, ray.o, ray.d,
                                       {query.ray.tfar, query.hit.u, query.hit.v});
  const TrianglePoint point = triangle_point(*mesh.surface, primitive, met.u, met.v);
  hit.t = met.t;
  hit.p = point.p;
  hit.p_error = point.error;
  hit.n = point.n;
  hit.ns = shading_normal(*mesh.surface, primitive, met.u, met.v, hit.n, ray.d);
}

Intersector::Intersector(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
Intersector::~Intersector() = default;

bool Intersector::intersect(const Ray& ray, Hit& hit) const {
  RTCRayHit query{};
  query.ray = embree_ray(ray, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree_intersect(impl_->embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  impl_->fill(query, ray, hit);
  return true;
}

bool Intersector::occluded(const Ray& ray, float tmax, std::uint32_t but_for) const {
  RTCRay query = embree_ray(ray, tmax);
  query.id = but_for == nothing ? nothing : impl_->plane_of[but_for];
  embree_occluded(impl_->embree, &query);
  return query.tfar < 0;
}

}  // namespace carlo
