#include "renderer/lanes/lane_plan.h"

#include "geometry/planes.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/match.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace renderer {
namespace {

using carlo::Parallelogram;

std::size_t numbers(const LaneBoxes& boxes, const carlo::Scene& scene) {
  const auto others = std::count_if(scene.shapes.begin(), scene.shapes.end(), in_no_box);
  return boxes.solids.size() * LaneScene::sides + (boxes.enclosure ? LaneScene::sides_used : 0) +
         boxes.others.size() + static_cast<std::size_t>(others);
}

/// The number of tests that find the nearest surface if all are tested.
std::size_t tries(const LaneBoxes& boxes, const carlo::Scene& scene) {
  std::vector<Parallelogram> quads;
  for (const std::size_t i : boxes.others)
    quads.push_back(std::get<Parallelogram>(scene.shapes[i].geometry));
  std::size_t planes = 0;
  const std::vector<carlo::Planes::Entry> of = carlo::find_planes(quads).of;
  for (std::size_t i = 0; i < of.size(); ++i)
    planes += of[i].first == i;
  const auto others = std::count_if(scene.shapes.begin(), scene.shapes.end(), in_no_box);
  return boxes.solids.size() + planes + static_cast<std::size_t>(others);
}

}  // namespace

std::optional<LaneBoxes> boxes_to_try(const carlo::Scene& scene) {
  if (scene.shapes.size() > LaneScene::few) return std::nullopt;
  LaneBoxes boxes = find_boxes(scene);
  if (numbers(boxes, scene) > LaneScene::few) return std::nullopt;
  if (tries(boxes, scene) > LaneScene::most_tried) return std::nullopt;
  return boxes;
}

LaneBoxes no_boxes(const carlo::Scene& scene) {
  LaneBoxes none;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    if (!in_no_box(scene.shapes[i])) none.others.push_back(i);
  return none;
}

namespace {

using carlo::Parallelogram;
using carlo::Vec3;
using Vec3d = glm::dvec3;

Extent extent_of_mesh(const carlo::Mesh& mesh) {
  Extent extent{Vec3d(std::numeric_limits<double>::infinity()),
                Vec3d(-std::numeric_limits<double>::infinity())};
  for (const Vec3& p : mesh.positions) {
    extent.lower = glm::min(extent.lower, Vec3d(p));
    extent.upper = glm::max(extent.upper, Vec3d(p));
  }
  return extent;
}

/// True if two extents are no further apart than a few roundings of their coordinates.
bool touch(const Extent& a, const Extent& b) {
  const Vec3d blur = 1e-5 * (glm::max(glm::abs(a.lower), glm::abs(a.upper)) +
                             glm::max(glm::abs(b.lower), glm::abs(b.upper)));
  const double margin = blur.x + blur.y + blur.z;
  return glm::all(glm::lessThanEqual(a.lower, b.upper + margin)) &&
         glm::all(glm::lessThanEqual(b.lower, a.upper + margin));
}

}  // namespace

Extent extent_of(const carlo::Shape& shape) {
  const auto of_quad = [](const Parallelogram& quad) -> Extent {
    const Vec3d o(quad.origin), u(quad.u), v(quad.v);
    return {o + glm::min(u, Vec3d(0)) + glm::min(v, Vec3d(0)),
            o + glm::max(u, Vec3d(0)) + glm::max(v, Vec3d(0))};
  };
  return carlo::match(
      shape.geometry, of_quad,
      [&](const carlo::Disk& disk) { return of_quad(square_around(disk)); },
      [](const carlo::Sphere& sphere) -> Extent {
        const Vec3d c(sphere.center), r(static_cast<double>(sphere.radius));
        return {c - r, c + r};
      },
      [](const carlo::Mesh& mesh) { return extent_of_mesh(mesh); },
      [](const carlo::Sdf& sdf) -> Extent {
        const carlo::sdf::Box box = carlo::sdf::bounds(sdf, sdf.place);
        return {box.lower, box.upper};
      });
}

bool in_no_box(const carlo::Shape& shape) {
  return carlo::match(
      shape.geometry, [](const Parallelogram&) { return false; },
      [](const carlo::Disk&) { return true; }, [](const carlo::Sphere&) { return true; },
      [](const carlo::Mesh&) { return true; }, [](const carlo::Sdf&) { return true; });
}

bool any_touches(const carlo::Scene& scene, const std::vector<std::size_t>& quads) {
  std::vector<std::size_t> loose = quads;
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    extents.push_back(extent_of(scene.shapes[i]));
    if (in_no_box(scene.shapes[i])) loose.push_back(i);
  }
  for (const std::size_t i : loose) {
    for (std::size_t j = 0; j < extents.size(); ++j)
      if (i != j && touch(extents[i], extents[j])) return true;
  }
  return false;
}

}  // namespace renderer
