// Probes of lab 8's exercises 8.1 to 8.3 and 8.5. They call the student's functions and return raw
// values; checks_*.cpp says what the values should be.

#include "08_path_tracer/places.h"
#include "08_path_tracer/scenes.h"
#include "grader/worker/probe.h"
#include "path_tracer.h"

#include <cmath>
#include <vector>

using namespace lab08_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

carlo::Phong phong_of(const Params& params) {
  const PhongCase c = phong_cases()[static_cast<std::size_t>(params.whole("case"))];
  return {Rgb(c.kd), Rgb(c.ks), c.n};
}

}  // namespace

// A camera that looks along -z with a square film as wide as it is far. Each row: where a ray went
// through its pixel (in pixels, from the pixel's top left), and how many rays there were.
PROBE("Lab 8.1 rays", "x in the pixel", "y in the pixel",
      "(last two rows: red and green of the mean; its blue and the number of rays)") {
  carlo::Camera camera;
  carlo::Rng rng(params.seed);
  const int x = static_cast<int>(params.whole("x")), y = static_cast<int>(params.whole("y"));
  const int strata = static_cast<int>(params.n);
  RowWriter rows;
  double calls = 0;
  const Rgb mean = lab08::pixel_radiance(
      camera, 16, 8, x, y, strata,
      [&](const carlo::Ray& ray) {
        calls += 1;
        rows.add({number(ray.d.x / -ray.d.z + 1) * 8 - x, number(1 - ray.d.y / -ray.d.z) * 4 - y});
        return Rgb(static_cast<float>(calls), 1, static_cast<float>(calls * calls));
      },
      rng);
  rows.add({number(mean.r), number(mean.g)});
  rows.add({number(mean.b), calls});
  return rows.take();
}

// Direct light at the floor's origin, by either form. The BRDF is wrong on purpose where the
// contract says that it is never called.
PROBE("Lab 8.2 estimates", "red", "green", "blue") {
  const auto light = static_cast<Light>(params.whole("light"));
  const lab08::World world(light_scene(light));
  const Pose pose = pose_of(light);
  carlo::Rng rng(params.seed);
  // One point, seen from many sides: each time it is rounded differently.
  std::vector<lab08::Surface> surfaces;
  for (int side = 0; side < 32; ++side) {
    const float azimuth = 0.2f * static_cast<float>(side);
    const Vec3 eye(0.3f * std::cos(azimuth), 0.3f * std::sin(azimuth), 0.9f);
    const auto met = world.intersect({pose.point(eye), glm::normalize(pose.direction(-eye))});
    if (met) surfaces.push_back(*met);
  }
  if (surfaces.empty()) return {};
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const lab08::Surface& surface = surfaces[static_cast<std::size_t>(i) % surfaces.size()];
    const lab08::Brdf f = [&](Vec3 wi) {
      return Rgb(glm::dot(wi, surface.n) > -1e-6f ? 0.5f / 3.14159265f : -1000.0f);
    };
    const Rgb L = params.whole("form") == 0 ? lab08::direct_by_area(world, surface, f, rng)
                                            : lab08::direct_by_hemisphere(world, surface, f, rng);
    rows.add({number(L.r), number(L.g), number(L.b)});
  }
  return rows.take();
}

PROBE("Lab 8.3 chances", "diffuse", "specular") {
  RowWriter rows;
  for (const auto& [kd, ks] : chance_cases()) {
    const lab08::LobeProbabilities chances = lab08::lobe_probabilities({kd, ks, 10});
    rows.add({number(chances.diffuse), number(chances.specular)});
  }
  return rows.take();
}

// f and pdf for every direction of places.h.
PROBE("Lab 8.3 values", "f", "pdf") {
  const carlo::Phong phong = phong_of(params);
  RowWriter rows;
  for (const DirectionPair& d : direction_pairs(phong.exponent)) {
    rows.add({number(lab08::evaluate(phong, d.normal, d.wo, d.wi).r),
              number(lab08::pdf(phong, d.normal, d.wo, d.wi))});
  }
  return rows.take();
}

PROBE("Lab 8.3 samples", "direction came", "wi.x", "wi.y", "wi.z", "weight", "pdf") {
  const carlo::Phong phong = phong_of(params);
  const Frame3 frame = tilted_frame();
  const Vec3 wo = frame.at(direction_at(static_cast<float>(params["degrees"]), 0));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float u_lobe = rng.uniform_float();
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const auto next = lab08::sample(phong, frame.n, wo, u_lobe, {u, v});
    if (!next) {
      rows.add({0, 0, 0, 0, 0, 0});
      continue;
    }
    rows.add({1, number(next->wi.x), number(next->wi.y), number(next->wi.z), number(next->weight.r),
              number(next->pdf)});
  }
  return rows.take();
}

PROBE("Lab 8.5 estimates", "estimate", "directions asked", "below the horizon", "within the cone") {
  const SplitCase c = split_cases()[static_cast<std::size_t>(params.whole("case"))];
  const lab08::Cone cone{c.axis, c.one_minus_cos};
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    double calls = 0, below = 0, within = 0;
    const lab08::Incoming incoming = [&](Vec3 wi) {
      calls += 1;
      // On the horizon the cosine is 0, so a call there adds 0.
      below += wi.z < -1e-6f ? 1 : 0;
      within += cone.contains(wi) ? 1 : 0;
      return cone.contains(wi) ? Rgb(c.light) : Rgb(c.elsewhere);
    };
    const lab08::Brdf f = [](Vec3) { return Rgb(1 / 3.14159265f); };
    const Vec3 n(0, 0, 1);
    const Rgb L = params.whole("one") == 0 ? lab08::reflect_split(cone, n, f, incoming, rng)
                                           : lab08::reflect_split_one(cone, n, f, incoming, rng);
    rows.add({number(L.r), calls, below, within});
  }
  return rows.take();
}
