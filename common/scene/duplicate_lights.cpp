#include "scene/duplicates.h"
#include "scene/repeats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

/// Relative to the largest coordinate: four float roundings, as for a corner that is a sum.
constexpr double rounding = 0x1p-22;

std::array<Vec3d, 4> corners_of(const Parallelogram& p) {
  const Vec3d o(p.origin), u(p.u), v(p.v);
  return {o, o + u, o + u + v, o + v};
}

double largest(Vec3d p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// A point that identical lights share, and its possible rounding error.
struct Middle {
  Vec3d point;
  double error;
};

struct MiddleOf {
  Middle operator()(const Parallelogram& p) const {
    Vec3d sum(0);
    double far = 0;
    for (const Vec3d& corner : corners_of(p))
      sum += corner, far = std::max(far, largest(corner));
    return {sum / 4.0, rounding * far};
  }
  template <class Round>
  Middle operator()(const Round& s) const {
    const Vec3d center(s.center);
    return {center, rounding * (largest(center) + static_cast<double>(s.radius))};
  }
  Middle operator()(const Mesh&) const { return {}; }  // compared by its triangles
  Middle operator()(const Sdf&) const { return {}; }   // no light
};

bool near(Vec3d a, Vec3d b, double error) {
  return largest(a - b) <= error;
}

bool near(float a, float b, double error) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b)) <= error;
}

/// Compares two shapes: true if they occupy the same place and face the same way.
struct SamePlace {
  double error;

  bool operator()(const Parallelogram& a, const Parallelogram& b) const {
    // The corners have the same cyclic order, from any of them on.
    const auto p = corners_of(a), q = corners_of(b);
    for (std::size_t start = 0; start < 4; ++start) {
      std::size_t i = 0;
      while (i < 4 && near(p.at(i), q.at((start + i) % 4), error))
        ++i;
      if (i == 4) return true;
    }
    return false;
  }
  bool operator()(const Sphere& a, const Sphere& b) const {
    return a.flipped == b.flipped && near(a.radius, b.radius, error) &&
           near(Vec3d(a.center), Vec3d(b.center), error);
  }
  bool operator()(const Disk& a, const Disk& b) const {
    return near(a.radius, b.radius, error) && near(Vec3d(a.center), Vec3d(b.center), error) &&
           near(Vec3d(a.normal), Vec3d(b.normal), 2 * rounding);
  }
  bool operator()(const Mesh&, const Mesh&) const { return false; }  // compared by their triangles
  bool operator()(const Sdf&, const Sdf&) const { return false; }    // no lights
  template <class A, class B>
  requires(!std::is_same_v<A, B>) bool operator()(const A&, const B&) const { return false; }
};

class DuplicateLights {
 public:
  DuplicateLights(Scene& scene, Position at) : scene_(scene), at_(at) {}

  void leave_out() {
    find_lights();
    find_triangles();
    if (shapes_ > 0) note(shapes_, "lights");
    if (triangles_ > 0) note(triangles_, "triangles of lights");
    if (shapes_ + triangles_ > 0) remove();
  }

 private:
  void note(std::size_t count, const char* what) {
    scene_.notes.push_back(
        fmt::format("{} {} left out that lie where others lie, facing the same way", count, what));
  }

  /// All but meshes. Sorted along a line that few planes of lights are perpendicular to, only
  /// neighbours can coincide.
  void find_lights() {
    gone_.resize(scene_.shapes.size());
    struct Light {
      double along, error;
      std::size_t shape;
    };
    std::vector<Light> lights;
    const Vec3d line(.36, .48, .8);
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const Shape& shape = scene_.shapes[i];
      if (!shape.emits() || std::holds_alternative<Mesh>(shape.geometry)) continue;
      const Middle middle = std::visit(MiddleOf{}, shape.geometry);
      lights.push_back({glm::dot(line, middle.point), middle.error, i});
    }
    std::sort(lights.begin(), lights.end(),
              [](const Light& a, const Light& b) { return a.along < b.along; });
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (std::size_t k = i + 1; k < lights.size(); ++k) {
        const double error = std::max(lights[i].error, lights[k].error);
        if (lights[k].along - lights[i].along > 2 * lights[i].error) break;
        const auto [first, second] = std::minmax(lights[i].shape, lights[k].shape);
        if (!std::visit(SamePlace{error}, scene_.shapes[first].geometry,
                        scene_.shapes[second].geometry))
          continue;
        require_same_light(first, second);
        shapes_ += gone_[second] == 0 ? 1 : 0;
        gone_[second] = 1;
      }
    }
  }

  struct LightTriangle {
    std::size_t shape, triangle;
    Triangle corners;
  };

  /// Halves of parallelograms come before all others: those stay.
  std::vector<LightTriangle> light_triangles() const {
    std::vector<LightTriangle> out;
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const Shape& shape = scene_.shapes[i];
      const auto* p = std::get_if<Parallelogram>(&shape.geometry);
      if (p == nullptr || !shape.emits() || gone_[i] != 0) continue;
      const auto c = corners_of(*p);
      for (std::size_t k = 0; k < 4; ++k)
        out.push_back({i, 0, {Vec3(c.at(k)), Vec3(c.at((k + 1) % 4)), Vec3(c.at((k + 2) % 4))}});
    }
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const Shape& shape = scene_.shapes[i];
      const auto* mesh = std::get_if<Mesh>(&shape.geometry);
      if (mesh == nullptr || !shape.emits()) continue;
      for (std::size_t k = 0; k < mesh->triangles.size(); ++k) {
        const glm::uvec3 t = mesh->triangles[k];
        out.push_back({i, k, {mesh->positions[t.x], mesh->positions[t.y], mesh->positions[t.z]}});
      }
    }
    return out;
  }

  bool may_share_triangles() const {
    std::size_t meshes = 0, parallelograms = 0;
    for (const Shape& shape : scene_.shapes) {
      if (!shape.emits()) continue;
      meshes += std::holds_alternative<Mesh>(shape.geometry) ? 1 : 0;
      parallelograms += std::holds_alternative<Parallelogram>(shape.geometry) ? 1 : 0;
    }
    return meshes > 0 && meshes + parallelograms > 1;
  }

  void find_triangles() {
    if (!may_share_triangles()) return;
    const std::vector<LightTriangle> all = light_triangles();
    std::vector<std::uint64_t> keys;
    keys.reserve(all.size());
    for (const LightTriangle& t : all)
      keys.push_back(spread(key_of(t.corners[0]) + key_of(t.corners[1]) + key_of(t.corners[2])));
    find_repeats(
        keys,
        [&](std::size_t i, std::size_t k) { return same_triangle(all[i].corners, all[k].corners); },
        [&](std::size_t later, std::size_t earlier) {
          require_same_light(all[earlier].shape, all[later].shape);
          mark(std::get<Mesh>(scene_.shapes[all[later].shape].geometry), all[later].triangle);
          ++triangles_;
        });
  }

  /// A triangle whose corners coincide is left out below.
  static void mark(Mesh& mesh, std::size_t triangle) {
    glm::uvec3& t = mesh.triangles[triangle];
    t = {t.x, t.x, t.x};
  }

  static void remove_marked(Mesh& mesh) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3 t = mesh.triangles[i];
      if (t.x == t.y && t.y == t.z) continue;
      mesh.triangles[kept] = t;
      if (!mesh.normals_of.empty()) mesh.normals_of[kept] = mesh.normals_of[i];
      if (!mesh.back_to_back.empty()) mesh.back_to_back[kept] = mesh.back_to_back[i];
      ++kept;
    }
    mesh.triangles.resize(kept);
    if (!mesh.back_to_back.empty()) mesh.back_to_back.resize(kept);
    if (!mesh.normals_of.empty()) mesh.normals_of.resize(kept);
  }

  void require_same_light(std::size_t i, std::size_t k) const {
    const Shape &a = scene_.shapes[i], &b = scene_.shapes[k];
    const bool same_material = scene_.materials[a.material] == scene_.materials[b.material];
    if (a.radiance == b.radiance && same_material) return;
    const auto text = [](Rgb c) { return fmt::format("({:g}, {:g}, {:g})", c.r, c.g, c.b); };
    fail(
        at_,
        "two lights lie in one place, facing the same way, and differ in {}: shapes {} and {} of the "
        "scene (cubes count sixfold), of radiances {} and {}",
        same_material ? "radiance" : "material", i + 1, k + 1, text(a.radiance), text(b.radiance));
  }

  void remove() {
    std::vector<Shape> shapes;
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      if (gone_[i] != 0) continue;
      Shape& shape = scene_.shapes[i];
      if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
        remove_marked(*mesh);
        if (mesh->triangles.empty()) continue;
      }
      shapes.push_back(std::move(shape));
    }
    scene_.shapes = std::move(shapes);
  }

  Scene& scene_;
  Position at_;
  std::vector<char> gone_;  ///< of the shapes
  std::size_t shapes_ = 0, triangles_ = 0;
};

}  // namespace

void leave_out_duplicate_lights(Scene& scene, Position at) {
  DuplicateLights(scene, at).leave_out();
}

}  // namespace carlo
