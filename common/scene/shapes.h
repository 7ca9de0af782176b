#pragma once

#include "scene/properties.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace carlo {

using Geometry = decltype(Shape::geometry);

/// The geometry of a <shape> in world space: one item, six for a cube. Reads only the geometric
/// properties. Normals follow toWorld (even if it mirrors) and flipNormals. Notes on what was left
/// out go to `notes`. Throws Error at what makes no sense; of several errors inside an sdf, all but
/// the last go to `errors`.
std::vector<Geometry> parse_geometry(Properties& shape, std::vector<std::string>& notes,
                                     SceneErrors& errors);

/// True if a parallelogram or triangle with these edges is too thin or small for a float normal.
bool is_degenerate(Vec3 edge1, Vec3 edge2);

/// Reads <shape type="sdf"> with the shapes inside it.
Sdf parse_sdf(Properties& shape, SceneErrors& errors);

/// Reads <shape type="obj"> and <shape type="ply">.
Mesh parse_mesh(Properties& shape, std::vector<std::string>& notes);

}  // namespace carlo
