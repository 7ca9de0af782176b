// Probes of Lab 7.7.

#include "07_hemisphere/lights.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "hemisphere.h"

#include <algorithm>
#include <array>

using namespace lab07_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

/// A surface, its light, and the sampling technique.
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

/// Streams of Rng(7, stream) whose first uniform_float() is the last float below 1, which occurs
/// once in 2^24 numbers; found by exhaustive search.
constexpr std::array<std::uint64_t, edge_streams> last_float_streams = {
    11998468,  14742555,  82817238,  104415125, 111509448, 118533986, 159975561, 173333219,
    176784087, 217789148, 235894363, 244954394, 280412877, 284885921, 286890080, 294656044,
    297607220, 303209965, 311898468, 318229023, 326440475, 333432321, 334264443, 335664426,
    338348193, 346877775, 365045033, 365618659, 375298350, 376024897, 383254848, 428306651,
    430276955, 446196691, 459488214, 485434640, 526617366, 549229509, 579186121, 581295432,
    593048923, 595260160, 631783317, 637557451, 657430469, 673389434, 705030547, 727879090};

}  // namespace

// ambient = 1 asks for the ambient occlusion of the same scene.
PROBE("Lab 7.7 estimates", "estimate") {
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

PROBE("Lab 7.7 record", "radiance was asked for", "of this below the horizon", "length off 1 by",
      "next word of rng", "next word 2", "next word 3", "next word 4") {
  const Surface surface(params);
  carlo::Rng rng(params.seed);
  double asked = 0, below = 0, off = 0;
  const lab07::Radiance radiance = [&](Vec3 wi) {
    asked += 1;
    // Rounding may move a direction at the horizon below it.
    below += glm::dot(Double3(wi), surface.axes.z) < -1e-6 ? 1 : 0;
    const double length = glm::length(Double3(wi));
    off = length == length ? std::max(off, std::abs(length - 1)) : 1e9;
    return 1.0f;
  };
  lab07::irradiance(radiance, surface.normal, surface.sampling, params.n, rng);
  const auto next = carlo::grader::next_words(rng);
  return {7, {asked, below, off, next[0], next[1], next[2], next[3]}};
}

// Estimates from one direction of the lobe, with u.x the last float below 1: it lies on the lobe's
// very edge, and turning may round it out of the lobe, where the density is 0. For mirror
// directions all around.
PROBE("Lab 7.7 edge", "estimate") {
  const Vec3 normal(params["x"], params["y"], params["z"]);
  const Axes axes(normal);
  const lab07::Radiance sky = [](Vec3) { return 1.0f; };
  RowWriter rows;
  for (const std::uint64_t stream : last_float_streams) {
    for (int i = 0; i < edge_mirrors; ++i) {
      const Double3 wo = at_angles(pi / 2 * (i + 0.5) / edge_mirrors, 2.399963229728653 * i);
      const lab07::Sampling sampling{lab07::Technique::lobe, Vec3(axes.world(wo)),
                                     static_cast<float>(params["exponent"])};
      carlo::Rng rng(7, stream);
      rows.add({lab07::irradiance(sky, normal, sampling, 1, rng)});
    }
  }
  return rows.take();
}

// The irradiance of an open sky from many directions at once, which all contribute the same.
PROBE("Lab 7.7 many", "irradiance") {
  carlo::Rng rng(params.seed);
  const lab07::Radiance sky = [](Vec3) { return 1.0f; };
  const lab07::Sampling sampling{lab07::Technique::cosine, {0, 0, 1}, 1};
  return {1, {lab07::irradiance(sky, {0, 0, 1}, sampling, params.n, rng)}};
}
