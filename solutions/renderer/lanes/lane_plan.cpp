#include "renderer/lanes/lane_plan.h"

#include "geometry/planes.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/lane_touching.h"

#include <algorithm>
#include <cstddef>
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

}  // namespace renderer
