#pragma once

#include "scene/scene.h"

#include <string>

namespace carlo {

/// 16 hexadecimal digits that identify a scene by everything its images depend on: all but the
/// number of samples and the notes. Equal scenes have equal fingerprints, however their files are
/// written.
std::string fingerprint(const Scene& scene);

}  // namespace carlo
