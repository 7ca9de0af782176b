#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>

namespace carlo {

/// Reads a scene in the subset of Mitsuba's XML that common/scene/README.md documents. `parameters`
/// override the file's <default> values ($name in attributes). Throws a PlacedError with a line
/// "FILE:LINE:COLUMN: error: what was found, what was expected" for each thing that is not
/// understood or makes no sense; nothing is ignored silently.
Scene load_scene(const std::filesystem::path& path,
                 const std::map<std::string, std::string>& parameters = {});

}  // namespace carlo
