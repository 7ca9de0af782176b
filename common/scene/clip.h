#pragma once

#include "scene/scene.h"
#include "scene/xml_source.h"

#include <optional>

namespace carlo {

/// The range of depths, along the direction of view, that a Mitsuba camera sees. Ours has no
/// limits.
struct ClipRange {
  std::optional<float> near_clip, far_clip;
  Position near_at, far_at;  ///< in the file
};

/// Reports each limit that cuts something off, or may: a surface nearer to the camera than the
/// image's corners at the near depth, or anything in front of the camera beyond the far one.
void check_clip(const Scene& scene, const ClipRange& clip, SceneErrors& errors);

}  // namespace carlo
