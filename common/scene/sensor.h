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

/// Reads <sensor type="perspective"> with its film and sampler: fills in the camera, the film's
/// size, the sampler and the samples per pixel. Errors go to `errors`. Returns the range for
/// check_clip(), once all shapes are there.
ClipRange parse_sensor(const XmlElement& element, Scene& scene, glm::dvec3 center,
                       SceneErrors& errors);

/// Reads <integrator type="path">: fills in the longest path.
void parse_integrator(const XmlElement& element, Scene& scene);

}  // namespace carlo
