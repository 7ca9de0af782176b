// A million photons and the power of their lights. A photon's contribution is known exactly where
// nothing is random; elsewhere means are judged with theory's standard deviation: seven z tests at
// |z| < 5.5 raise a false alarm for less than 1e-6 of all seeds. They confirm the power of a closed
// room to one or two parts in a thousand.

#include "bias.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

using namespace lab09;

namespace {

constexpr std::int64_t million = 1'000'000;
using Double3 = glm::dvec3;

struct Arrived {
  Double3 first{0}, all{0};
  std::int64_t photons = 0;
};

/// Traces a million photons and returns the mean flux stored per photon.
Arrived send(const World& world) {
  Rng rng(9);
  Arrived arrived;
  for (std::int64_t i = 0; i < million; ++i) {
    bool first = true;
    trace_photon(world, emit_photon(world, rng), rng, [&](const Photon& photon) {
      const Double3 flux = Double3(photon.flux) / static_cast<double>(million);
      if (first) arrived.first += flux;
      first = false;
      arrived.all += flux;
      ++arrived.photons;
    });
  }
  return arrived;
}

std::uint32_t add(carlo::Scene& scene, const carlo::Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Double3 times_pi(double area, Double3 radiance) {
  return std::numbers::pi * area * radiance;
}

/// True if a mean of a million values is right.
bool is_mean(double mean, double exact, double sd) {
  return std::abs(mean - exact) < 5.5 * sd / std::sqrt(static_cast<double>(million));
}

}  // namespace

TEST_CASE("photons: mirrors and glass lose and add nothing") {
  carlo::Scene scene;
  const auto black = add(scene, {carlo::Diffuse{Rgb(0)}, false});
  const auto glass = add(scene, {carlo::Dielectric{1.5f, 1}, false});
  const auto mirror = add(scene, {carlo::Mirror{Rgb(1)}, false});
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 3, true}, black, Rgb(0)},
                  {carlo::Sphere{{0.6f, 0, 0}, 0.5f}, glass, Rgb(0)},
                  {carlo::Sphere{{-0.6f, 0, 0}, 0.5f}, mirror, Rgb(0)},
                  {carlo::Sphere{{0.6f, 0, 0}, 0.2f}, black, Rgb(0)},
                  // Grey lights of equal power, so that all photons carry the same flux.
                  {carlo::Disk{{0, 0, 1}, {0, 0, -1}, 0.5f}, black, Rgb(2)},
                  {carlo::Sphere{{0, 1.5f, 0}, 0.1f}, black, Rgb(12.5f)}};
  const World world(scene);
  const Double3 power = times_pi(std::numbers::pi * 0.25, Double3(2)) +
                        times_pi(4 * std::numbers::pi * 0.01, Double3(12.5));
  const Arrived arrived = send(world);
  CHECK(arrived.photons == million);
  CHECK(glm::length(arrived.all / power - Double3(1)) < 1e-5);
}

TEST_CASE("photons: of lights of several colours all power arrives") {
  carlo::Scene scene;
  const auto black = add(scene, {carlo::Diffuse{Rgb(0)}, false});
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 3, true}, black, Rgb(0)},
                  {carlo::Disk{{0, 0, 1}, {0, 0, 1}, 0.5f}, black, {8, 1, 0}},
                  {carlo::Disk{{0, 0, -1}, {0, 0, -1}, 1}, black, {0, 1, 2}}};
  const World world(scene);
  const Double3 first = times_pi(std::numbers::pi * 0.25, {8, 1, 0});
  const Double3 second = times_pi(std::numbers::pi, {0, 1, 2});
  const auto luminance_of = [](Double3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  const double chance = (luminance_of(first) / luminance_of(first + second) + 0.5) / 2;
  const Arrived arrived = send(world);
  for (int i = 0; i < 3; ++i) {
    // One of two values, first/chance or second/(1 - chance).
    const double sd =
        std::abs(first[i] / chance - second[i] / (1 - chance)) * std::sqrt(chance * (1 - chance));
    CHECK(is_mean(arrived.all[i], first[i] + second[i], sd));
  }
}

TEST_CASE("photons: in a closed room of albedo rho the power arrives 1/(1 - rho) times") {
  carlo::Scene scene;
  const Rgb albedo{0.5f, 0.25f, 0.1f};
  scene.shapes = {
      {carlo::Sphere{{0, 0, 0}, 2, true}, add(scene, {carlo::Diffuse{albedo}, false}), Rgb(1)}};
  const World world(scene);
  const Double3 power = times_pi(16 * std::numbers::pi, Double3(1));
  const Arrived arrived = send(world);
  CHECK(glm::length(arrived.first / power - Double3(1)) < 1e-5);
  for (int i = 0; i < 3; ++i) {
    // 1 + w + w^2 + ..., as long as the photon continues, with probability q each time.
    const auto q = static_cast<double>(albedo.r), rho = static_cast<double>(albedo[i]), w = rho / q;
    const double exact = 1 / (1 - rho), square = (1 + 2 * rho * exact) / (1 - q * w * w);
    CHECK(is_mean(arrived.all[i] / power[i], exact, std::sqrt(square - exact * exact)));
  }
}
