#pragma once

#include "scene/scene.h"
#include "scene/xml_source.h"

#include <optional>

namespace carlo {

/// Between which depths, along the direction of view, a camera of Mitsuba sees. Ours has no limits.
struct ClipRange {
  std::optional<float> near_clip, far_clip;
  Position near_at, far_at;  ///< in the file
};

/// Tells of each limit that cuts something off, or may: a surface nearer to the camera than the
/// corners of the image are at the near depth, anything in front of the camera behind the far one.
void check_clip(const Scene& scene, const ClipRange& clip, SceneErrors& errors);

}  // namespace carlo
