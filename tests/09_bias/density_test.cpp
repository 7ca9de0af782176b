// Lab 9's photons, all steps together, where the answer is known: all light comes by exactly one
// way; and how fast the errors of shrinking discs and of paths fall.

#include "bias.h"
#include "given/sampled.h"
#include "mirrored_light.h"
#include "sampling/samplers.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

using carlo::Rgb;
using carlo::Rng;
using carlo::Vec3;
using lab09::MirroredLight;
using lab09::Photon;
using lab09::PhotonMap;

namespace {

/// A sphere that emits 1 and reflects a half, with a ball of glass at its middle: the radiance is 2
/// everywhere, and a distance encloses as much area on a sphere as on a plane.
carlo::Scene furnace_with_glass() {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(0.5f)}, false}, {carlo::Dielectric{1.5f, 1}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 2, true}, 0, Rgb(1)},
                  {carlo::Sphere{{0, 0, 0}, 0.8f}, 1, Rgb(0)}};
  return scene;
}

PhotonMap emitted_map(const lab09::World& world, int emitted, bool caustics, Rng& rng) {
  std::vector<Photon> photons;
  for (int i = 0; i < emitted; ++i) {
    lab09::trace_photon(world, lab09::emit_photon(world, rng), rng, [&](const Photon& photon) {
      if (!caustics || photon.caustic()) photons.push_back(photon);
    });
  }
  return {std::move(photons), 1 / static_cast<float>(emitted)};
}

/// The mean over rays from a point beside the ball in all directions.
double mean_radiance(int rays, Rng& rng, const std::function<Rgb(const carlo::Ray&)>& radiance) {
  double sum = 0;
  for (int i = 0; i < rays; ++i) {
    const lab09::Emission to = lab09::emit_from_point({1, 0, 0.5f}, Rgb(1), rng);
    sum += static_cast<double>(radiance(to.ray).g);
  }
  return sum / rays;
}

/// Root mean square errors of runs, relative.
double rms(int runs, double exact, const std::function<Rgb()>& three_points) {
  double squares = 0;
  for (int run = 0; run < runs; ++run) {
    const Rgb points = three_points();
    for (int i = 0; i < 3; ++i) {
      const double off = static_cast<double>(points[i]) / exact - 1;
      squares += off * off / (3 * runs);
    }
  }
  return std::sqrt(squares);
}

Rgb by_map(const MirroredLight& light, double radius, Rng& rng) {
  const PhotonMap map = emitted_map(light.world, 512, true, rng);
  Rgb radiances(0);
  for (int i = 0; i < 3; ++i) {
    radiances[i] =
        lab09::photon_radiance(light.world, light.ray(i), map, static_cast<float>(radius), rng).g;
  }
  return radiances;
}

Rgb by_paths(const MirroredLight& light, unsigned samples, Rng& rng) {
  constexpr int segments = 3;  // floor, mirror, light
  glm::dvec3 sum(0);
  for (int i = 0; i < 3; ++i) {
    carlo::SampleId id{rng.next_u64(), 0, 0, samples};
    for (; id.index < samples; ++id.index) {
      lab08::Sampled<carlo::IndependentSampler> numbers(id);
      sum[i] +=
          static_cast<double>(lab08::path_radiance(light.world, light.ray(i), segments, numbers).g);
    }
  }
  return sum / static_cast<double>(samples);
}

}  // namespace

TEST_CASE("density: a furnace with glass is 2 by a map of all photons, and by caustics and paths") {
  const lab09::World world(furnace_with_glass());
  Rng rng(1);
  const PhotonMap all = emitted_map(world, 40'000, false, rng);
  const PhotonMap caustics = emitted_map(world, 40'000, true, rng);
  CHECK(caustics.size() > 1000);
  const double by_all = mean_radiance(4'000, rng, [&](const carlo::Ray& ray) {
    return lab09::photon_radiance(world, ray, all, 0.2f, rng);
  });
  const double by_caustics = mean_radiance(20'000, rng, [&](const carlo::Ray& ray) {
    return lab09::caustic_radiance(world, ray, caustics, 0.2f, rng);
  });
  CHECK(std::abs(by_all - 2) < 0.03);
  CHECK(std::abs(by_caustics - 2) < 0.03);
}

TEST_CASE("density: discs that shrink converge with a slope of -1/3, discs that do not with 0") {
  const MirroredLight light(0.02);
  Rng rng(1);
  std::vector<double> passes, shrinking, staying;
  for (const int n : {1, 4, 16, 64, 256}) {
    passes.push_back(n);
    shrinking.push_back(rms(12, light.exact(), [&] {
      return lab09::progressive_mean(
          n, 0.4, 2 / 3.0, [&](int, double radius) { return by_map(light, radius, rng); });
    }));
    staying.push_back(rms(12, light.exact(), [&] {
      Rgb sum(0);
      for (int i = 0; i < n; ++i)
        sum += by_map(light, 0.4, rng) / static_cast<float>(n);
      return sum;
    }));
  }
  const double slope = lab09::fitted_slope(passes, shrinking);
  CAPTURE(slope, shrinking, staying);
  CHECK(std::abs(slope + 1 / 3.0) < 0.08);
  CHECK(staying[4] > 1.5 * shrinking[4]);
  CHECK(staying[4] > 0.8 * staying[3]);
}

TEST_CASE("density: paths to the same light converge with a slope of -1/2") {
  const MirroredLight light(0.1);
  Rng rng(1);
  std::vector<double> samples, errors;
  for (const unsigned n : {1024u, 4096u, 16384u}) {
    samples.push_back(n);
    errors.push_back(rms(24, light.exact(), [&] { return by_paths(light, n, rng); }));
  }
  const double slope = lab09::fitted_slope(samples, errors);
  CAPTURE(slope, errors);
  CHECK(std::abs(slope + 0.5) < 0.08);
}
