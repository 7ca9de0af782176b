#pragma once

#include <filesystem>

namespace bench {

/// Writes a wavy ball of about `triangles` triangles as binary PLY, and a scene that shows it under
/// a light; returns the scene's path. The folder must exist. Throws Error.
std::filesystem::path write_ball_scene(const std::filesystem::path& folder, int triangles);

}  // namespace bench
