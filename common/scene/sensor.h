#pragma once

#include "scene/clip.h"
#include "scene/scene.h"
#include "scene/xml_source.h"

namespace carlo {

/// Reads <sensor type="perspective"> with its film and sampler: fills in the camera, the film's
/// size, the sampler and the samples per pixel. Errors go to `errors`. Returns the range for
/// check_clip(), once all shapes are there.
ClipRange parse_sensor(const XmlElement& element, Scene& scene, glm::dvec3 center,
                       SceneErrors& errors);

/// Reads <integrator type="path">: fills in the longest path.
void parse_integrator(const XmlElement& element, Scene& scene);

}  // namespace carlo
