#pragma once

#include "call.h"
#include "scene/scene.h"

// Scenes as numbers: the native program reads files, which a page cannot, and writes what this
// reads.

namespace site {

/// A scene's camera, materials, shapes and constant environment as numbers. Throws carlo::Error for
/// what lab 8 does not support, and for triangles and signed distance functions.
Numbers numbers_of(carlo::Scene scene);

/// A scene that the page has given (scene.add), with a square film.
carlo::Scene scene_with_film(std::size_t number, int size);

}  // namespace site
