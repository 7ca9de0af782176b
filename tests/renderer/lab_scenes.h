#pragma once

#include "course/cli/source_folder.h"
#include "scene/load_scene.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace lab_scenes {

inline std::filesystem::path folder() {
  return carlo::source_folder() / "common/scenes";
}

/// The scenes of common/scenes, in alphabetical order, without their suffix.
inline std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() == ".xml") result.push_back(entry.path().stem().string());
  }
  std::sort(result.begin(), result.end());
  return result;
}

inline carlo::Scene load(const std::string& name) {
  return carlo::load_scene(folder() / (name + ".xml"));
}

}  // namespace lab_scenes
