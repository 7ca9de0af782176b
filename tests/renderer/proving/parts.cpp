#include "proving/parts.h"

#include "scene_tools.h"

#include <cmath>
#include <utility>
#include <variant>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene, carlo::Shape, carlo::Vec3;
using glm::dmat3, glm::dvec3;

/// Moves the points of a shape; leaves an Sdf alone, since no scene has one.
class Mover {
 public:
  explicit Mover(const Placement& placement) : p_(placement) {}

  Vec3 point(const Vec3& x) const { return Vec3(p_.scale * (p_.turn * dvec3(x) + p_.shift)); }
  Vec3 vector(const Vec3& x) const { return Vec3(p_.scale * (p_.turn * dvec3(x))); }
  Vec3 normal(const Vec3& x) const { return Vec3(glm::normalize(p_.turn * dvec3(x))); }
  float length(float x) const { return static_cast<float>(p_.scale * static_cast<double>(x)); }

  void operator()(carlo::Parallelogram& s) const {
    s = {point(s.origin), vector(s.u), vector(s.v)};
  }
  void operator()(carlo::Sphere& s) const {
    s.center = point(s.center);
    s.radius = length(s.radius);
  }
  void operator()(carlo::Disk& s) const {
    s = {point(s.center), normal(s.normal), length(s.radius)};
  }
  void operator()(carlo::Mesh& s) const {
    for (Vec3& x : s.positions)
      x = point(x);
  }
  void operator()(carlo::Sdf&) const {}

 private:
  Placement p_;
};

}  // namespace

double Random::magnitude(double low, double high) {
  return std::pow(10.0, uniform(std::log10(low), std::log10(high)));
}

dvec3 Random::direction() {
  const double z = uniform(-1, 1), phi = uniform(0, 2 * 3.14159265358979323846);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

dmat3 rotation(int number) {
  if (number == 0) return dmat3(1);
  Random random(1000 + static_cast<std::uint64_t>(number));
  const dvec3 x = random.direction(), y = glm::normalize(glm::cross(x, random.direction()));
  return {x, y, glm::cross(x, y)};
}

Scene placed(Scene scene, const Placement& placement) {
  const Mover move(placement);
  for (Shape& shape : scene.shapes)
    std::visit(move, shape.geometry);
  auto& [points, environment, envmap] = scene.lights;
  (void)environment;  // is everywhere
  if (envmap) envmap->rotation = placement.turn * envmap->rotation;
  for (carlo::PointLight& light : points) {
    light.position = move.point(light.position);
    light.intensity *= static_cast<float>(placement.scale * placement.scale);
  }
  carlo::Camera& camera = scene.camera;
  camera.origin = move.point(camera.origin);
  camera.right = move.normal(camera.right);
  camera.up = move.normal(camera.up);
  camera.forward = move.normal(camera.forward);
  return scene;
}

Scene empty(int size) {
  Scene scene;
  scene.width = scene.height = size;
  scene.sampler = carlo::SamplerKind::independent;
  return scene;
}

carlo::Material diffuse(Rgb albedo, bool two_sided) {
  return {carlo::Diffuse{albedo}, two_sided};
}

carlo::Material lobeless_phong(Rgb albedo, bool two_sided) {
  return {carlo::Phong{albedo, Rgb(0), 20}, two_sided};
}

Shape panel(dvec3 centre, dvec3 a, dvec3 b, Finish finish) {
  return {carlo::Parallelogram{Vec3(centre - a - b), Vec3(2.0 * a), Vec3(2.0 * b)}, finish.material,
          finish.radiance};
}

Shape level(double half, double y, Finish finish) {
  return panel({0, y, 0}, {0, 0, half}, {half, 0, 0}, finish);
}

Shape ball(dvec3 centre, double radius, Finish finish, Facing facing) {
  return {carlo::Sphere{Vec3(centre), static_cast<float>(radius), facing == Facing::inwards},
          finish.material, finish.radiance};
}

void add_box(Scene& scene, const Box& box, Finish finish, Facing facing) {
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const dvec3 out = box.half[axis] * box.turn[axis];
    const dvec3 a = (box.half[next] + box.margin) * box.turn[next];
    const dvec3 b = (box.half[last] + box.margin) * box.turn[last];
    for (const double side : {-1.0, 1.0}) {
      const bool along = (side > 0) == (facing == Facing::outwards);
      scene.shapes.push_back(panel(box.centre + side * out, along ? a : b, along ? b : a, finish));
    }
  }
}

Shape octahedron(dvec3 centre, double radius, Finish finish) {
  carlo::Mesh mesh;
  for (const double side : {1.0, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      dvec3 corner(0);
      corner[axis] = side * radius;
      mesh.positions.push_back(Vec3(centre + corner));
    }
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1 ? 3 : 0, y = octant & 2 ? 4 : 1, z = octant & 4 ? 5 : 2;
    const bool odd = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;  // mirrored an odd number of
                                                                       // times
    mesh.triangles.push_back(odd ? glm::uvec3(x, z, y) : glm::uvec3(x, y, z));
  }
  return {std::move(mesh), finish.material, finish.radiance};
}

carlo::Camera camera_at(dvec3 from, dvec3 at, double fov_degrees) {
  const dvec3 forward = glm::normalize(at - from);
  const Vec3 up = std::abs(forward.y) > .99 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  return scene_tools::look_at(Vec3(from), Vec3(at), up, fov_degrees);
}

std::array<double, 3> exact_of(Rgb value) {
  return {static_cast<double>(value.x), static_cast<double>(value.y), static_cast<double>(value.z)};
}

std::array<double, 3> exact_of(double value) {
  return {value, value, value};
}

}  // namespace proving
