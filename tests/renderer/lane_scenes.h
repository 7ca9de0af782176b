#pragma once

#include "scene/scene.h"

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

struct Named {
  std::string name;
  carlo::Scene scene;
};

/// The scenes of the tree that the kernel supports, and those above.
std::vector<Named> all();

}  // namespace lane_scenes
