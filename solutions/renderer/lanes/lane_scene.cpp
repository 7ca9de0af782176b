#include "renderer/lanes/lane_scene.h"

#include "geometry/planes.h"
#include "numeric/robust.h"
#include "renderer/lanes/lane_boxes.h"
#include "renderer/lanes/lane_columns.h"
#include "renderer/lanes/lane_plan.h"
#include "scene/center.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace renderer {
namespace {

using carlo::Parallelogram;
using carlo::Rgb;
using carlo::Vec3;
using Vec3d = glm::dvec3;

/// True if the sampler's points are Sobol', false if they are independent; nothing for samplers
/// that the kernels do not know.
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

/// Writes the shapes' columns one by one.
class Writer {
 public:
  Writer(LaneScene& lanes, const carlo::Scene& scene)
      : lanes_(lanes), scene_(scene), close_(carlo::diameter(scene) / 1000) {
    const auto& [points, environment, envmap] = scene.lights;
    (void)points, (void)environment;  // environment is left to rays that meet no surface
    if (!envmap) return;
    lanes.sky_far =
        rounded(std::min(2 * carlo::diameter(scene), 1e18));  // its square fits into a float
    lanes.sky.emplace(*envmap);
  }

  void quad(std::size_t number, std::size_t shape_index) {
    const carlo::Shape& shape = scene_.shapes[shape_index];
    const auto& quad = std::get<Parallelogram>(shape.geometry);
    plane(number, quad, shape);
    if (!shape.emits()) return;
    add_edges(lanes_, lanes_.lights, quad.origin, quad.u, quad.v);
    const Vec3d u(quad.u), v(quad.v);
    flat_light(number, shape, area(quad), Vec3d(quad.origin) + 0.5 * (u + v),
               0.5 * std::max(glm::length(u + v), glm::length(u - v)));
  }

  void disk(const carlo::Shape& shape, const carlo::Disk& disk) {
    const std::size_t i = lanes_.surfaces++;
    plane(i, square_around(disk), shape);
    if (!shape.emits()) return;
    lanes_.disk_lights = true;
    const Frame frame(disk.normal);
    add_edges(lanes_, lanes_.lights, disk.center, disk.radius * frame.s, disk.radius * frame.t);
    flat_light(i, shape, area(disk), Vec3d(disk.center), static_cast<double>(disk.radius));
  }

  /// Adds a box that takes this many numbers.
  void box(const FoundBox& box, std::uint32_t numbers) {
    for (std::size_t face = 0; face < box.shape.size(); ++face)
      if (box.shape[face]) quad(lanes_.surfaces + face, *box.shape[face]);
    lanes_.surfaces += numbers;
  }

  void sphere(const carlo::Shape& shape, const carlo::Sphere& sphere) {
    const std::size_t i = lanes_.surfaces++;
    lanes_.cx[i] = sphere.center.x, lanes_.cy[i] = sphere.center.y, lanes_.cz[i] = sphere.center.z;
    lanes_.radius[i] = sphere.flipped ? -sphere.radius : sphere.radius;
    lanes_.width[i] = 2 * sphere.radius;
    const Vec3 c = glm::abs(sphere.center);
    lanes_.coordinates[i] = c.x + c.y + c.z + sphere.radius;
    lanes_.plane[i] = static_cast<std::uint32_t>(i);
    look(i, shape);
    if (!shape.emits()) return;
    lanes_.sphere_lights = true;
    // From every direction as bright as a disk of its radius.
    light(i, shape, sphere.flipped ? area(sphere) : 2 * carlo::pi, area(sphere),
          {.middle = Vec3d(sphere.center),
           .reach = static_cast<double>(sphere.radius),
           .strength = area(sphere) / 4});
  }

  void sdf(const carlo::Shape& shape, const carlo::Sdf& sdf) {
    const std::size_t i = lanes_.surfaces++;
    lanes_.sdfs.push_back(lane_sdf(sdf));
    lanes_.plane[i] = static_cast<std::uint32_t>(i);
    look(i, shape);
  }

  /// Takes the number after the last mesh's.
  void mesh(const carlo::Shape& shape, const carlo::Mesh& mesh) {
    const std::size_t i = lanes_.surfaces++;
    lanes_.plane[i] = static_cast<std::uint32_t>(i);
    look(i, shape);
    lanes_.mesh_lights.emplace_back();
    if (!shape.emits()) return;
    lanes_.any_mesh_light = true;
    const MeshLight& lit = lanes_.mesh_lights.back().emplace(mesh);
    const LightBounds& bounds = lit.bounds();
    // Between the contribution when all of it faces the point (area) and that of a closed mesh
    // (area / 4).
    light(i, shape, lit.area(), lit.area(),
          {.middle = 0.5 * (bounds.lower + bounds.upper),
           .reach = 0.5 * glm::length(bounds.upper - bounds.lower),
           .strength = lit.area() / 2});
  }

  /// Comes after all lights that are surfaces. A scene without surfaces has nothing to light. No
  /// path starts there.
  void sky() {
    if (!lanes_.sky || lanes_.surfaces == 0) return;
    lanes_.sky_light = lanes_.lights++;
    // The mean over all orientations of a surface.
    lights_.push_back({.strength = lanes_.sky->brightness / 4, .everywhere = true});
  }

  /// Comes after the image.
  void point(const carlo::PointLight& light) {
    if (light.intensity == Rgb(0)) return;
    const std::size_t l = lanes_.lights++;
    add_edges(lanes_, l, light.position, Vec3(0), Vec3(0));
    lanes_.intensity_r[l] = light.intensity.r, lanes_.intensity_g[l] = light.intensity.g,
    lanes_.intensity_b[l] = light.intensity.b;
    lights_.push_back({.middle = Vec3d(light.position),
                       .strength = sum(light.intensity),
                       .power = 4 * carlo::pi * sum(light.intensity)});
    brighten(light.intensity, close_ * close_);
  }

  /// Called after all lights and planes.
  void choices() {
    for (std::uint32_t l = 0; l < lanes_.lights; ++l) {
      if (!lights_[l].plane) continue;
      const std::uint32_t i = lanes_.light_surface[l];
      lights_[l].plane = {Vec3d(lanes_.nx[i], lanes_.ny[i], lanes_.nz[i]),
                          static_cast<double>(lanes_.d[i])};
    }
    lanes_.choice = LaneLights(lights_);
    for (std::uint32_t l = 0; l < lanes_.lights; ++l) {
      const auto probability = static_cast<double>(lanes_.choice.start_probability[l]);
      if (l >= lanes_.first_point)
        lanes_.point_emission[l] = rounded(probability / (4 * carlo::pi));
      else if (!lights_[l].everywhere)
        lanes_.emission[lanes_.light_surface[l]] = rounded(probability / areas_[l] / carlo::pi);
    }
  }

  /// Gives all surfaces of a plane the number and the coordinates of the first.
  void share_planes() {
    const carlo::Planes planes = carlo::find_planes(quads_);
    for (std::size_t k = 0; k < quads_.size(); ++k) {
      const std::size_t i = numbers_[k], first = numbers_[planes.of[k].first];
      if (first == i) continue;
      const float along = lanes_.nx[i] * lanes_.nx[first] + lanes_.ny[i] * lanes_.ny[first] +
                          lanes_.nz[i] * lanes_.nz[first];
      const float sign = along < 0 ? -1.0f : 1.0f;
      lanes_.plane[i] = static_cast<std::uint32_t>(first);
      lanes_.nx[i] = sign * lanes_.nx[first], lanes_.ny[i] = sign * lanes_.ny[first];
      lanes_.nz[i] = sign * lanes_.nz[first], lanes_.d[i] = sign * lanes_.d[first];
      lanes_.coplanar = lanes_.coplanar || by_itself(k) || by_itself(planes.of[k].first);
    }
  }

 private:
  /// True if the parallelogram quads_[k] is hit or sampled on its own, not as a side of a box.
  bool by_itself(std::size_t k) const {
    const std::size_t i = numbers_[k];
    return i >= lanes_.first_quad || lanes_.light_density[i] > 0;
  }

  void plane(std::size_t number, const Parallelogram& quad, const carlo::Shape& shape) {
    add_plane(lanes_, number, quad);
    lanes_.plane[number] = static_cast<std::uint32_t>(number);
    lanes_.coordinates[number] = std::abs(lanes_.d[number]);
    quads_.push_back(quad);
    numbers_.push_back(number);
    look(number, shape);
  }

  /// Adds the light that surface i is; its points or directions are uniform over `measure`.
  void light(std::size_t i, const carlo::Shape& shape, double measure, double area,
             LaneLights::Light light) {
    lanes_.light_of[i] = lanes_.lights;
    lanes_.light_surface[lanes_.lights++] = static_cast<std::uint32_t>(i);
    lanes_.light_density[i] = rounded(1 / measure);
    light.strength *= sum(shape.radiance);
    light.power = carlo::pi * area * sum(shape.radiance);
    lights_.push_back(light);
    areas_.push_back(area);
    brighten(shape.radiance, 1);
  }
  /// share_planes() may still change the plane.
  void flat_light(std::size_t i, const carlo::Shape& shape, double area, Vec3d middle,
                  double reach) {
    light(i, shape, area, area,
          {.middle = middle, .reach = reach, .strength = area, .plane = LaneLight::Plane{}});
  }

  void brighten(const carlo::Rgb& radiance, double per) {
    const auto most = static_cast<double>(std::max({radiance.r, radiance.g, radiance.b}));
    lanes_.brightest = std::max(lanes_.brightest, most / per);
  }

  void look(std::size_t i, const carlo::Shape& shape) {
    const carlo::Material& material = scene_.materials[shape.material];
    const Reflectances r = reflectances(material);
    lanes_.material[i] = shape.material;
    lanes_.le_r[i] = shape.radiance.r, lanes_.le_g[i] = shape.radiance.g,
    lanes_.le_b[i] = shape.radiance.b;
    lanes_.phong = lanes_.phong || (!r.specular && r.ks != Rgb(0));
    lanes_.any_specular = lanes_.any_specular || r.specular;
    lanes_.one_sided = lanes_.one_sided || !(material.two_sided || r.ior > 0);
  }

  LaneScene& lanes_;
  const carlo::Scene& scene_;
  double close_;  ///< a thousandth of the scene
  std::vector<LaneLights::Light> lights_;
  std::vector<double> areas_;  ///< of the lights that are surfaces, which come first
  std::vector<Parallelogram> quads_;
  std::vector<std::size_t> numbers_;  ///< their numbers
};

/// Entries for this many surfaces or lights and for the rest of the last register.
std::size_t room_for(std::size_t entries) {
  return entries + 16;
}

std::size_t emitters(const carlo::Scene& scene) {
  const auto surfaces = std::count_if(scene.shapes.begin(), scene.shapes.end(),
                                      [](const carlo::Shape& s) { return s.emits(); });
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment;  // is not sampled
  return static_cast<std::size_t>(surfaces) + points.size() + (envmap ? 1 : 0);
}

/// Builds a tree over shapes that get numbers from `first` on, and sorts them by these.
template <class Shape, class ShapeOf>
LaneTree tree_over(std::vector<Shape>& shapes, std::uint32_t first, const ShapeOf& shape_of) {
  std::vector<Extent> extents;
  for (const Shape& shape : shapes)
    extents.push_back(extent_of(shape_of(shape)));
  std::vector<std::size_t> order;
  LaneTree tree(extents, first, order);
  std::vector<Shape> sorted;
  for (const std::size_t i : order)
    sorted.push_back(shapes[i]);
  shapes = std::move(sorted);
  return tree;
}

template <class Kind>
using Found = std::vector<std::pair<const carlo::Shape*, const Kind*>>;

/// The shapes that are not parallelograms, by kind.
struct Sorted {
  Found<carlo::Disk> disks;
  Found<carlo::Sphere> spheres;
  Found<carlo::Sdf> sdfs;
  Found<carlo::Mesh> meshes;
};

Sorted sort(const carlo::Scene& scene) {
  Sorted sorted;
  for (const carlo::Shape& shape : scene.shapes) {
    carlo::match(
        shape.geometry, [](const Parallelogram&) {},
        [&](const carlo::Disk& s) { sorted.disks.emplace_back(&shape, &s); },
        [&](const carlo::Sphere& s) { sorted.spheres.emplace_back(&shape, &s); },
        [&](const carlo::Mesh& s) { sorted.meshes.emplace_back(&shape, &s); },
        [&](const carlo::Sdf& s) { sorted.sdfs.emplace_back(&shape, &s); });
  }
  return sorted;
}

}  // namespace

bool LaneScene::suits(const carlo::Needs& needs, const carlo::Scene& scene) {
  carlo::Needs others = needs;
  others.parallelograms = others.disks = others.spheres = others.sdfs = 0;
  others.meshes = others.triangles = 0;
  others.parallelogram_lights = others.disk_lights = others.sphere_lights = 0;
  others.triangle_lights = others.point_lights = 0;
  others.diffuse = others.phong = others.mirror = others.dielectric = false;
  others.one_sided = others.two_sided = false;
  others.environment = others.envmap = others.depth_limit = others.vertex_normals = false;
  return others == carlo::Needs{} && sobol_points(scene.sampler) && scene.shapes.size() <= most &&
         needs.sdfs + needs.meshes <= few && emitters(scene) <= most &&
         scene.materials.size() <= most_materials;
}

double LaneScene::splat_unit(std::uint64_t paths) const {
  if (!(brightest > 0)) return 1;
  int above = 0;  // the next power of 2
  if (std::frexp(brightest * static_cast<double>(paths), &above) == 0.5) --above;
  return std::ldexp(1.0, above - 50);
}

LaneScene::LaneScene(const carlo::Scene& scene)
    : room(room_for(std::max(scene.shapes.size(), few))), light_room(room_for(emitters(scene))) {
  sobol = sobol_points(scene.sampler).value();
  const auto& [points, around, envmap] = scene.lights;
  (void)envmap;  // Writer
  environment[0] = around.r, environment[1] = around.g, environment[2] = around.b;
  for (const carlo::Material& m : scene.materials)
    add_material(*this, m);
  Writer write(*this, scene);
  const std::optional<LaneBoxes> to_try = boxes_to_try(scene);
  many = !to_try;
  const LaneBoxes boxes = many ? no_boxes(scene) : *to_try;
  for (const FoundBox& solid : boxes.solids) {
    solids.push_back(solid.box);
    if (solids.size() > 1)
      solids.back().parallel = solids.back().axis == solids[solids.size() - 2].axis;
    write.box(solid, sides);
  }
  if (boxes.enclosure) {
    enclosed = true;
    camera_inside = boxes.camera_inside;
    enclosure = boxes.enclosure->box;
    write.box(*boxes.enclosure, sides_used);
  }
  first_quad = surfaces;
  std::vector<std::size_t> others = boxes.others;
  if (many)
    quad_tree = tree_over(others, surfaces,
                          [&](std::size_t i) -> const carlo::Shape& { return scene.shapes[i]; });
  else
    others = in_patches(scene, others);
  for (const std::size_t i : others)
    write.quad(surfaces++, i);
  // Parallelograms already have their numbers.
  Sorted sorted = sort(scene);
  const auto shape_of = [](const auto& found) -> const carlo::Shape& { return *found.first; };
  first_disk = surfaces;
  if (many) disk_tree = tree_over(sorted.disks, surfaces, shape_of);
  for (const auto& [shape, disk] : sorted.disks)
    write.disk(*shape, *disk);
  first_sphere = surfaces;
  if (many) sphere_tree = tree_over(sorted.spheres, surfaces, shape_of);
  for (const auto& [shape, sphere] : sorted.spheres)
    write.sphere(*shape, *sphere);
  first_sdf = surfaces;
  for (const auto& [shape, sdf] : sorted.sdfs)
    write.sdf(*shape, *sdf);
  first_mesh = surfaces;
  std::vector<const carlo::Mesh*> traced;
  for (const auto& [shape, mesh] : sorted.meshes) {
    write.mesh(*shape, *mesh);
    traced.push_back(mesh);
    smooth = smooth || !mesh->normals_of.empty();
  }
  if (!traced.empty()) meshes = std::make_unique<carlo::MeshTracer>(traced);
  write.sky();
  first_point = lights;
  for (const carlo::PointLight& light : points)
    write.point(light);
  write.share_planes();
  write.choices();
  touching = many || any_touches(scene, boxes.others);
  if (many) return;
  for (std::uint32_t i = first_disk; i-- > first_quad;)
    run_end[i] = i + 1 < first_disk && plane[i] == plane[i + 1] ? run_end[i + 1] : i + 1;
  bound_patches(scene, others, *this);
  flat_lights = first_point > 0 && !sky && around == Rgb(0);
  for (std::uint32_t i = 0; i < first_point; ++i)
    flat_lights = flat_lights && light_surface[i] >= first_quad && light_surface[i] < first_disk;
}

}  // namespace renderer
