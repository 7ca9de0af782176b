#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lane_scenes {

/// Made for features that no scene of the tree has.
carlo::Scene assorted();
carlo::Scene boxes();
carlo::Scene polished();
carlo::Scene modelled();
carlo::Scene triangulated();
carlo::Scene skylit();
carlo::Scene crowded();

/// Adds the six sides of the box of corner `origin` and edges u, v, w, which face outwards.
void add_box(carlo::Scene& scene, carlo::Vec3 origin, carlo::Vec3 u, carlo::Vec3 v, carlo::Vec3 w,
             std::uint32_t material, carlo::Rgb radiance = carlo::Rgb(0));

struct Named {
  std::string name;
  carlo::Scene scene;
};

/// The scenes of the tree that the kernel supports, and those above.
std::vector<Named> all();

}  // namespace lane_scenes
