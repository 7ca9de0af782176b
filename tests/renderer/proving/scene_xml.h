#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace proving {

/// A scene as a file for load_scene() (common/scene/README.md), its coordinates rounded again. Its
/// meshes, and the image around it, are files beside it.
std::string scene_xml(const carlo::Scene& scene, const std::string& comment);

/// Writes the scene, its meshes and its image, under names that start with `name`, into a folder;
/// returns the scene's path.
std::filesystem::path write_scene(const carlo::Scene& scene, const std::filesystem::path& folder,
                                  const std::string& name, const std::string& comment);

}  // namespace proving
