#pragma once

#include <filesystem>

namespace carlo {

/// Writes a torus knot as binary PLY: a tube with flutes that wind around it, with vertex normals,
/// closed, about 3.5 across, its centre at the origin. It has about `triangles` triangles, 588 at
/// least. Throws Error if the file cannot be written.
void write_knot(const std::filesystem::path& file, int triangles);

}  // namespace carlo
