// Lab 7: hemisphere samplers as points on a dome, and irradiance known in closed form.

#include "07_hemisphere/scenes.h"
#include "call.h"
#include "hemisphere.h"

#include <algorithm>
#include <cmath>

namespace site {
namespace {

using namespace lab07;

/// A number of [0, 1) in the i-th of n strata, as the float that samplers take.
float in_stratum(std::int64_t i, double n, float u) {
  const auto place = static_cast<float>((static_cast<double>(i) + static_cast<double>(u)) / n);
  return std::min(place, 0x1.fffffep-1f);
}

/// technique (0 rejection, 1 uniform, 2 cosine, 3 mirror lobe), exponent, angle of wo with the
/// normal in degrees, side, jittered (0 or 1), seed: side^2 directions, then the darts.
Numbers dome(const Arguments& given) {
  const std::int64_t side = given.whole(3), technique = given.whole(0);
  const auto n = static_cast<float>(given[1]);
  const auto theta = static_cast<float>(given[2] / 180 * 3.14159265358979324);
  const Vec3 wo(-std::sin(theta), 0, std::max(std::cos(theta), 0.0f));
  carlo::Rng rng = given.rng(5, 3);
  Numbers results;
  double darts = 0;
  for (std::int64_t i = 0; i < side * side; ++i) {
    darts += 1;
    Vec3 w;
    if (technique == 0) {
      const lab07::Accepted accepted = sample_uniform_by_rejection({0, 0, 1}, rng);
      w = accepted.w;
      darts += static_cast<double>(accepted.darts) - 1;
    } else {
      const float x = rng.uniform_float();
      const float y = rng.uniform_float();
      const Vec2 u = given[4] == 0 ? Vec2(x, y)
                                   : Vec2(in_stratum(i % side, given[3], x),
                                          in_stratum(i / side, given[3], y));
      w = technique == 1   ? sample_uniform_hemisphere(u)
          : technique == 2 ? sample_cosine_hemisphere(u)
                           : sample_mirror_lobe(u, wo, n);
    }
    for (int k = 0; k < 3; ++k)
      results.push_back(static_cast<double>(w[k]));
  }
  results.push_back(darts);
  return results;
}

/// exponent, angle of wo in degrees, directions, seed: the share of a mirror lobe's directions that
/// fall below the horizon, and the mean angle with the mirror direction, in degrees, by the sine:
/// the cosine rounds to 1.
Numbers lobe(const Arguments& given) {
  const auto theta = static_cast<float>(given[1] / 180 * 3.14159265358979324);
  const Vec3 wo(-std::sin(theta), 0, std::max(std::cos(theta), 0.0f)),
      mirror = mirror_direction(wo);
  carlo::Rng rng = given.rng(3, 2);
  double below = 0, angle = 0;
  for (std::int64_t i = 0; i < given.whole(2); ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    const Vec3 w = sample_mirror_lobe({x, y}, wo, static_cast<float>(given[0]));
    below += w.z < 0 ? 1 : 0;
    angle += 2 * std::asin(std::min(1.0, 0.5 * glm::length(glm::dvec3(w) - glm::dvec3(mirror))));
  }
  return {below / given[2], angle / given[2] * 180 / 3.14159265358979324};
}

/// scene, technique (0 rejection, 1 uniform, 2 cosine, 3 lobe), x, y, directions, runs, seed: the
/// RMS error of the irradiance (or ambient occlusion) of the floor's point, relative to the exact
/// value; the exact value.
Numbers floor_error(const Arguments& given) {
  const Scene scene = scenes().at(given.index(0));
  const Vec3 p(static_cast<float>(given[2]), static_cast<float>(given[3]), 0);
  Sampling sampling{static_cast<Technique>(given.whole(1))};
  if (sampling.technique == Technique::lobe && scene.light) {
    // As the lab's experiment has it: a lobe that points at the light and falls to 1/e at its rim.
    const Vec3 to_light = scene.centre - p, w = glm::normalize(to_light);
    const float ratio = glm::length(to_light) / scene.radius;
    sampling.wo = {-w.x, -w.y, w.z};
    sampling.n = 2 * ratio * ratio;
  } else {
    sampling.n = 2;
  }
  carlo::Rng rng = given.rng(6, 4);
  const auto trial = [&] {
    return scene.light ? irradiance([&](Vec3 wi) { return scene.hit(p, wi) ? 1.0f : 0.0f; },
                                    {0, 0, 1}, sampling, given.whole(4), rng)
                       : ambient_occlusion([&](Vec3 wi) { return !scene.hit(p, wi); }, {0, 0, 1},
                                           sampling, given.whole(4), rng);
  };
  const double exact = scene.exact(p);
  return {rms_error(given.whole(5), exact, trial) / exact, exact};
}

const Function functions[] = {{"7.dome", dome}, {"7.lobe", lobe}, {"7.floor", floor_error}};

}  // namespace
}  // namespace site
