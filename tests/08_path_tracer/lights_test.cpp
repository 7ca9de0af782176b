// The probabilities with which World::choose() selects lab 8's lights. Exact: each light is
// selected by its chance() times 2^24 of the 2^24 numbers that Rng::uniform_float() can return.

#include "08_path_tracer/scenes.h"
#include "given/light_choice.h"
#include "given/world.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <vector>

using namespace lab08_tests;

namespace {

constexpr double step = 0x1p-24;

/// The number of values of uniform_float() that choose each light.
std::vector<double> numbers_of(const lab08::World& world) {
  std::vector<double> counts(world.lights().size());
  for (std::uint32_t i = 0; i < 1U << 24; ++i)
    counts[static_cast<std::size_t>(&world.choose(i * step) - world.lights().data())] += 1;
  return counts;
}

void check_chances(const lab08::World& world) {
  const std::vector<double> counts = numbers_of(world);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    wrong += counts[i] * step == static_cast<double>(world.lights()[i].chance()) ? 0 : 1;
  CHECK(wrong == 0);
  // Numbers with more digits belong to the step that they lie in.
  const lab08::Light& last = world.choose(1 - 0x1p-53);
  CHECK(&last == &world.choose(1 - step));
}

/// A light that is a mesh: a far triangle of 5e9 m^2, one without area, and one of half a square
/// metre.
carlo::Scene uneven_mesh() {
  carlo::Scene scene = light_scene(Light::none);
  carlo::Mesh mesh;
  mesh.positions = {{0, 0, 1e6f}, {0, 1e5f, 1e6f}, {1e5f, 0, 1e6f},
                    {0, 0, 1},    {0, 1, 1},       {1, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 4}, {3, 4, 5}};
  scene.shapes.push_back({mesh, 1, Rgb(3)});
  return scene;
}

}  // namespace

TEST_CASE("Lab 08: a weak light beside a sun is chosen a quarter of the time") {
  const lab08::World world(light_scene(Light::weak));
  check_chances(world);
  CHECK(world.lights()[0].chance() == 0.25f);
  CHECK(world.lights()[1].chance() == 0.75f);
}

TEST_CASE("Lab 08: each triangle of a mesh is a light, and one without area is never chosen") {
  const carlo::Scene scene = uneven_mesh();
  const lab08::World world(scene);
  REQUIRE(world.lights().size() == 3);
  check_chances(world);
  CHECK(world.lights()[1].chance() == 0);
  // Half of the even half: the triangle without area gets no part of it.
  CHECK(world.lights()[2].chance() == 0.25f);
  const auto met = world.intersect({{0.2f, 0.2f, 0.5f}, {0, 0, 1}});
  REQUIRE(met);
  CHECK(world.light_of(*met) == &world.lights()[2]);
  CHECK(world.light_of(*met)->area() == 0.5f);
}

TEST_CASE("Lab 08: of ten thousand lights of all powers none is left out") {
  carlo::Scene scene = light_scene(Light::none);
  const int lights = 10'000;
  for (int i = 0; i < lights; ++i) {
    const auto x = static_cast<float>(i);
    scene.shapes.push_back({carlo::Parallelogram{{x, 0, 1}, {0, 1, 0}, {1, 0, 0}}, 1,
                            Rgb(std::pow(10.0f, static_cast<float>(i % 20) - 10))});
  }
  const lab08::World world(scene);
  check_chances(world);
  for (const lab08::Light& light : world.lights())
    REQUIRE(static_cast<double>(light.chance()) >= 0.5 / lights - step);
}

TEST_CASE("Lab 08: lights whose chances would round to nothing are refused") {
  const std::vector<lab08::LightWeight> weights = {{1, 1 - 0x1p-23}, {1, 0x1p-23}};
  CHECK_THROWS_AS(lab08::LightChoice(weights), carlo::Error);
}
