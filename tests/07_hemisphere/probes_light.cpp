// Probes of Lab 7.7.

#include "07_hemisphere/lights.h"
#include "07_hemisphere/words.h"
#include "grader/worker/probe.h"
#include "hemisphere.h"

#include <algorithm>

using namespace lab07_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

/// A surface, its light, and how it is to be sampled.
struct Surface {
  Vec3 normal;
  Axes axes;
  Light light;
  lab07::Sampling sampling;

  explicit Surface(const Params& params)
      : normal(params["x"], params["y"], params["z"]),
        axes(normal),
        light(static_cast<Light>(params.whole("light"))),
        sampling{static_cast<lab07::Technique>(params.whole("technique")), normal,
                 static_cast<float>(params["exponent"])} {
    if (params.whole("aim") != 0) {  // the lobe points at the light
      const Double3 c = light_centre(light);
      sampling.wo = axes.world({-c.x, -c.y, c.z});
    }
  }

  bool lit(Vec3 wi) const { return lab07_tests::lit(light, axes.local(wi)); }
};

}  // namespace

// ambient = 1 asks for the ambient occlusion of the same scene.
PROBE("Lab 7.7 estimates") {
  const Surface surface(params);
  carlo::Rng rng(params.seed);
  const lab07::Radiance radiance = [&](Vec3 wi) { return surface.lit(wi) ? 1.0f : 0.0f; };
  const lab07::Visible visible = [&](Vec3 wi) { return surface.lit(wi); };
  const bool ambient = params.whole("ambient") != 0;
  RowWriter rows;
  for (std::int64_t i = 0; i < params.whole("repetitions"); ++i) {
    rows.add(
        {ambient
             ? lab07::ambient_occlusion(visible, surface.normal, surface.sampling, params.n, rng)
             : lab07::irradiance(radiance, surface.normal, surface.sampling, params.n, rng)});
  }
  return rows.take();
}

// Columns: how often radiance was asked for, how often below the horizon, the largest deviation of
// a direction's length from 1, words drawn.
PROBE("Lab 7.7 record") {
  const Surface surface(params);
  carlo::Rng rng(params.seed);
  const carlo::Rng before = rng;
  double asked = 0, below = 0, off = 0;
  const lab07::Radiance radiance = [&](Vec3 wi) {
    asked += 1;
    // Rounding may take a direction at the horizon below it.
    below += glm::dot(Double3(wi), surface.axes.z) < -1e-6 ? 1 : 0;
    const double length = glm::length(Double3(wi));
    off = length == length ? std::max(off, std::abs(length - 1)) : 1e9;
    return 1.0f;
  };
  lab07::irradiance(radiance, surface.normal, surface.sampling, params.n, rng);
  return {4, {asked, below, off, words_drawn(before, rng, 64 * params.n)}};
}
