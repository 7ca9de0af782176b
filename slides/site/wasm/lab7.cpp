// Lab 7: hemisphere samplers as points on a dome, and irradiance known in closed form.

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

/// technique (0 rejection, 1 uniform, 2 cosine, 3 lobe), radius of a round light of radiance 1 at
/// height 1, distance of the floor's point from its foot, directions, runs, seed: the RMS error of
/// the irradiance relative to the exact value; the exact value.
Numbers floor_error(const Arguments& given) {
  const double r2 = given[1] * given[1], x2 = given[2] * given[2], a = x2 + 1;
  const double exact =
      1.57079632679489662 * (1 - (a - r2) / std::sqrt((a + r2) * (a + r2) - 4 * r2 * x2));
  const auto distance = static_cast<float>(given[2]), radius = static_cast<float>(given[1]);
  Sampling sampling{static_cast<Technique>(given.whole(0))};
  // The lobe points at the light and falls to 1/e at its rim.
  const Vec3 to_light = glm::normalize(Vec3(-distance, 0, 1));
  sampling.wo = {-to_light.x, -to_light.y, to_light.z};
  sampling.n = 2 * (distance * distance + 1) / (radius * radius);
  const auto light = [=](Vec3 wi) {
    const float x = distance + wi.x / wi.z, y = wi.y / wi.z;
    return wi.z > 0 && x * x + y * y < radius * radius ? 1.0f : 0.0f;
  };
  carlo::Rng rng = given.rng(5, 3);
  const auto trial = [&] { return irradiance(light, {0, 0, 1}, sampling, given.whole(3), rng); };
  return {rms_error(given.whole(4), exact, trial) / exact, exact};
}

const Function functions[] = {{"7.dome", dome}, {"7.lobe", lobe}, {"7.floor", floor_error}};

}  // namespace
}  // namespace site
