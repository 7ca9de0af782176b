#include "renderer/flat/flat_scene.h"

#include "geometry/planes.h"
#include "numeric/robust.h"
#include "renderer/flat/flat_boxes.h"
#include "renderer/flat/flat_shape.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace renderer {
namespace {

using carlo::Parallelogram;
using carlo::Rgb;
using carlo::Vec3;
using Vec3d = glm::dvec3;

struct Reflectances {
  Rgb kd{0}, ks{0};
  float exponent = 0;
};

/// Of a material that the kernels know. FlatScene::suits() lets no surface have another.
std::optional<Reflectances> reflectances(const carlo::Material& material) {
  using Result = std::optional<Reflectances>;
  return carlo::match(
      material.model,
      [](const carlo::Diffuse& m) -> Result {
        return {{m.reflectance, Rgb(0), 0}};
      },
      [](const carlo::Phong& m) -> Result {
        return {{m.kd, m.ks, m.exponent}};
      },
      [](const carlo::Mirror&) -> Result { return {}; },
      [](const carlo::Dielectric&) -> Result { return {}; });
}

/// Whether the points of a sampler that the kernels know are Sobol's; if not, they are independent.
std::optional<bool> sobol_points(carlo::SamplerKind kind) {
  switch (kind) {
    case carlo::SamplerKind::independent:
      return false;
    case carlo::SamplerKind::sobol:
      return true;
    case carlo::SamplerKind::stratified:
      return std::nullopt;
  }
  return std::nullopt;
}

double sum(Rgb c) {
  return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
}

float f(double x) {
  return static_cast<float>(x);
}

void add_plane(FlatScene& flat, std::size_t i, const Parallelogram& quad) {
  const Vec3d o(quad.origin), u(quad.u), v(quad.v), n = glm::normalize(glm::cross(u, v));
  // The dual vectors: a . u = 2, a . v = 0, and the other way round.
  const Vec3d across = glm::cross(v, n), a = 2.0 * across / glm::dot(across, u);
  const Vec3d along = glm::cross(n, u), b = 2.0 * along / glm::dot(along, v);
  flat.nx[i] = f(n.x), flat.ny[i] = f(n.y), flat.nz[i] = f(n.z);
  flat.d[i] = f(glm::dot(n, o));
  flat.ax[i] = f(a.x), flat.ay[i] = f(a.y), flat.az[i] = f(a.z);
  flat.a0[i] = f(glm::dot(a, o) + 1);
  flat.bx[i] = f(b.x), flat.by[i] = f(b.y), flat.bz[i] = f(b.z);
  flat.b0[i] = f(glm::dot(b, o) + 1);
}

void add_material(FlatScene& flat, const carlo::Material& material) {
  const std::size_t i = flat.materials++;
  const std::optional<Reflectances> r = reflectances(material);
  if (!r) return;
  const Vec3d kd = Vec3d(r->kd) / carlo::pi,
              ks = Vec3d(r->ks) * (static_cast<double>(r->exponent) + 2) / (2 * carlo::pi);
  flat.kd_r[i] = f(kd.r), flat.kd_g[i] = f(kd.g), flat.kd_b[i] = f(kd.b);
  flat.ks_r[i] = f(ks.r), flat.ks_g[i] = f(ks.g), flat.ks_b[i] = f(ks.b);
  flat.exponent[i] = r->exponent;
  const double d = sum(r->kd), s = sum(r->ks);
  flat.diffuse[i] = d + s > 0 ? f(d / (d + s)) : 1;
  flat.two_sided[i] = material.two_sided ? 1 : 0;
}

double area(const Parallelogram& quad) {
  return glm::length(glm::cross(Vec3d(quad.u), Vec3d(quad.v)));
}

/// Of a light, what light sampling's choice goes by.
double power(const carlo::Shape& shape) {
  if (!shape.emits()) return 0;
  return sum(shape.radiance) *
         match_flat(
             shape, [](const Parallelogram& quad) { return area(quad); },
             [](const carlo::Sphere&) -> double {
               throw carlo::Error("the vector kernel has no lamps that are spheres");
             });
}

void add_light(FlatScene& flat, std::size_t i, const Parallelogram& quad, double chance,
               double running) {
  const std::size_t l = flat.lights++;
  flat.lx[l] = quad.origin.x, flat.ly[l] = quad.origin.y, flat.lz[l] = quad.origin.z;
  flat.lux[l] = quad.u.x, flat.luy[l] = quad.u.y, flat.luz[l] = quad.u.z;
  flat.lvx[l] = quad.v.x, flat.lvy[l] = quad.v.y, flat.lvz[l] = quad.v.z;
  flat.light_surface[l] = static_cast<std::uint32_t>(i);
  flat.light_cdf[l] = f(running);
  flat.light_density[i] = f(chance / area(quad));
}

/// Writes the shapes' columns one by one.
class Writer {
 public:
  Writer(FlatScene& flat, const carlo::Scene& scene) : flat_(flat), scene_(scene) {
    for (const carlo::Shape& shape : scene.shapes)
      power_ += power(shape);
  }

  void quad(std::size_t number, std::size_t shape_index) {
    const carlo::Shape& shape = scene_.shapes[shape_index];
    const auto& quad = std::get<Parallelogram>(shape.geometry);
    add_plane(flat_, number, quad);
    flat_.plane[number] = static_cast<std::uint32_t>(number);
    flat_.coordinates[number] = std::abs(flat_.d[number]);
    quads_.push_back(quad);
    numbers_.push_back(number);
    look(number, shape);
    if (!shape.emits()) return;
    const double chance = power(shape) / power_;
    add_light(flat_, number, quad, chance, running_ += chance);
  }

  /// A box that takes so many numbers.
  void box(const FoundBox& box, std::uint32_t numbers) {
    for (std::size_t face = 0; face < box.shape.size(); ++face)
      if (box.shape[face]) quad(flat_.surfaces + face, *box.shape[face]);
    flat_.surfaces += numbers;
  }

  void sphere(const carlo::Shape& shape, const carlo::Sphere& sphere) {
    const std::size_t i = flat_.surfaces++;
    flat_.cx[i] = sphere.center.x, flat_.cy[i] = sphere.center.y, flat_.cz[i] = sphere.center.z;
    flat_.radius[i] = sphere.flipped ? -sphere.radius : sphere.radius;
    flat_.width[i] = 2 * sphere.radius;
    const Vec3 c = glm::abs(sphere.center);
    flat_.coordinates[i] = c.x + c.y + c.z + sphere.radius;
    flat_.plane[i] = static_cast<std::uint32_t>(i);
    look(i, shape);
  }

  /// Surfaces of one plane get the number and the numbers of the first.
  void share_planes() {
    const carlo::Planes planes = carlo::find_planes(quads_);
    for (std::size_t k = 0; k < quads_.size(); ++k) {
      const std::size_t i = numbers_[k], first = numbers_[planes.of[k].first];
      if (first == i) continue;
      const float along = flat_.nx[i] * flat_.nx[first] + flat_.ny[i] * flat_.ny[first] +
                          flat_.nz[i] * flat_.nz[first];
      const float sign = along < 0 ? -1.0f : 1.0f;
      flat_.plane[i] = static_cast<std::uint32_t>(first);
      flat_.nx[i] = sign * flat_.nx[first], flat_.ny[i] = sign * flat_.ny[first];
      flat_.nz[i] = sign * flat_.nz[first], flat_.d[i] = sign * flat_.d[first];
      flat_.coplanar = flat_.coplanar || by_itself(k) || by_itself(planes.of[k].first);
    }
  }

 private:
  /// Whether the parallelogram quads_[k] is met or aimed at as such, not as a side of a box.
  bool by_itself(std::size_t k) const {
    const std::size_t i = numbers_[k];
    return i >= flat_.first_quad || flat_.light_density[i] > 0;
  }

  void look(std::size_t i, const carlo::Shape& shape) {
    const carlo::Material& material = scene_.materials[shape.material];
    flat_.material[i] = shape.material;
    flat_.le_r[i] = shape.radiance.r, flat_.le_g[i] = shape.radiance.g,
    flat_.le_b[i] = shape.radiance.b;
    flat_.phong = flat_.phong || reflectances(material).value().ks != Rgb(0);
    flat_.one_sided = flat_.one_sided || !material.two_sided;
  }

  FlatScene& flat_;
  const carlo::Scene& scene_;
  double power_ = 0, running_ = 0;
  std::vector<Parallelogram> quads_;
  std::vector<std::size_t> numbers_;  ///< theirs
};

struct Extent {
  Vec3d lower, upper;
};

Extent extent_of(const carlo::Shape& shape) {
  return match_flat(
      shape,
      [](const Parallelogram& quad) -> Extent {
        const Vec3d o(quad.origin), u(quad.u), v(quad.v);
        return {o + glm::min(u, Vec3d(0)) + glm::min(v, Vec3d(0)),
                o + glm::max(u, Vec3d(0)) + glm::max(v, Vec3d(0))};
      },
      [](const carlo::Sphere& sphere) -> Extent {
        const Vec3d c(sphere.center), r(static_cast<double>(sphere.radius));
        return {c - r, c + r};
      });
}

bool is_sphere(const carlo::Shape& shape) {
  return match_flat(
      shape, [](const Parallelogram&) { return false; }, [](const carlo::Sphere&) { return true; });
}

/// Whether two extents are no further apart than some roundings of their coordinates.
bool touch(const Extent& a, const Extent& b) {
  const Vec3d blur = 1e-5 * (glm::max(glm::abs(a.lower), glm::abs(a.upper)) +
                             glm::max(glm::abs(b.lower), glm::abs(b.upper)));
  const double margin = blur.x + blur.y + blur.z;
  return glm::all(glm::lessThanEqual(a.lower, b.upper + margin)) &&
         glm::all(glm::lessThanEqual(b.lower, a.upper + margin));
}

/// FlatScene::touching, `quads` the parallelograms outside of boxes.
bool any_touches(const carlo::Scene& scene, const std::vector<std::size_t>& quads) {
  std::vector<std::size_t> loose = quads;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (is_sphere(scene.shapes[i])) loose.push_back(i);
  }
  for (const std::size_t i : loose) {
    for (std::size_t j = 0; j < scene.shapes.size(); ++j)
      if (i != j && touch(extent_of(scene.shapes[i]), extent_of(scene.shapes[j]))) return true;
  }
  return false;
}

/// How many numbers the scene's surfaces take.
std::size_t numbers(const carlo::Scene& scene) {
  const FlatBoxes boxes = find_boxes(scene);
  const auto spheres = std::count_if(scene.shapes.begin(), scene.shapes.end(), is_sphere);
  return boxes.solids.size() * FlatScene::sides + (boxes.enclosure ? FlatScene::sides_used : 0) +
         boxes.others.size() + static_cast<std::size_t>(spheres);
}

}  // namespace

bool FlatScene::suits(const carlo::Needs& needs, const carlo::Scene& scene) {
  carlo::Needs others = needs;
  others.parallelograms = others.spheres = others.parallelogram_lights = 0;
  others.diffuse = others.phong = others.one_sided = others.two_sided = false;
  others.environment = others.depth_limit = false;
  return others == carlo::Needs{} && sobol_points(scene.sampler) && needs.primitives() <= most &&
         scene.materials.size() <= most_materials && numbers(scene) <= most;
}

FlatScene::FlatScene(const carlo::Scene& scene) {
  sobol = sobol_points(scene.sampler).value();
  const Rgb around = scene.lights.environment;
  environment[0] = around.r, environment[1] = around.g, environment[2] = around.b;
  for (const carlo::Material& m : scene.materials)
    add_material(*this, m);
  Writer write(*this, scene);
  const FlatBoxes boxes = find_boxes(scene);
  for (const FoundBox& solid : boxes.solids) {
    solids.push_back(solid.box);
    write.box(solid, sides);
  }
  if (boxes.enclosure) {
    enclosed = true;
    camera_inside = boxes.camera_inside;
    enclosure = boxes.enclosure->box;
    write.box(*boxes.enclosure, sides_used);
  }
  first_quad = surfaces;
  for (const std::size_t i : boxes.others)
    write.quad(surfaces++, i);
  first_sphere = surfaces;
  for (const carlo::Shape& shape : scene.shapes) {
    match_flat(
        shape, [](const Parallelogram&) {},  // has its number already
        [&](const carlo::Sphere& sphere) { write.sphere(shape, sphere); });
  }
  write.share_planes();
  touching = any_touches(scene, boxes.others);
}

}  // namespace renderer
