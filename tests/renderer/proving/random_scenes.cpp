#include "proving/ground.h"
#include "proving/parts.h"

#include <array>
#include <cstddef>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

Rgb random_colour(Random& random, double low, double high) {
  const auto one = [&] { return static_cast<float>(random.uniform(low, high)); };
  const float r = one(), g = one(), b = one();
  return {r, g, b};
}

/// Scattering surfaces, of both kinds and sides; in half of the scenes one is replaced by a mirror,
/// glass or both.
void add_materials(Scene& scene, Random& random) {
  for (int i = 0; i < 4; ++i) {
    const Rgb kd = random_colour(random, .1, .5), ks = random_colour(random, .05, .3);
    const auto exponent = static_cast<float>(random.magnitude(1, 30));
    const bool two_sided = i < 2;
    scene.materials.push_back(i % 2 == 0
                                  ? diffuse(kd, two_sided)
                                  : carlo::Material{carlo::Phong{kd, ks, exponent}, two_sided});
  }
  if (random.uniform() < .3)
    scene.materials[1] = {carlo::Mirror{random_colour(random, .3, .9)}, true};
  if (random.uniform() < .3) {
    const auto ior = static_cast<float>(random.uniform(1.1, 2));
    scene.materials[2] = {
        random.uniform() < .3 ? carlo::Dielectric{1, ior} : carlo::Dielectric{ior, 1}, false};
  }
}

/// Adds an object at a distance of at least its own size from the camera, which is at the origin.
/// Returns its position.
dvec3 add_thing(Scene& scene, Random& random, int number, bool balls_shine) {
  const double size = random.magnitude(number < 2 ? .3 : .01, 1);
  const dvec3 centre = (.1 + size * random.uniform(2, 4)) * random.direction();
  Finish finish{static_cast<std::uint32_t>(random.uniform(0, 4))};
  const double kind = random.uniform(), shine = random.uniform();
  // A bound on radiance keeps rare bright paths, and so skewness, small.
  const Rgb radiance = random_colour(random, .5, 4);
  if ((number == 0 || shine < .3) && (balls_shine || kind >= .3)) finish.radiance = radiance;
  const glm::dmat3 turn = rotation(static_cast<int>(random.uniform(1, 1e6)));
  const dvec3 half =
      size * dvec3(random.uniform(.05, 1), random.uniform(.05, 1), random.uniform(.05, 1));
  if (kind < .3) {
    scene.shapes.push_back(ball(centre, size, finish));
  } else if (kind < .6) {
    add_box(scene, {centre, half, turn}, finish, Facing::outwards);
  } else {
    scene.shapes.push_back(
        panel(centre, half.x * turn[0], half.y * (turn[1] + .4 * turn[0]), finish));
  }
  return centre;
}

}  // namespace

Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene = empty(8);
  add_materials(scene, random);
  const int count = 2 + static_cast<int>(random.uniform(0, 12));
  dvec3 look(0);
  for (int i = 0; i < count; ++i) {
    const dvec3 at = add_thing(scene, random, i, seed % 2 == 0);
    if (i < 2) look += glm::normalize(at);
  }
  if (random.uniform() < .5)
    scene.shapes.push_back(level(random.magnitude(3, 1e4), -random.magnitude(.05, 2)));
  if (random.uniform() < .3)
    add_box(scene, {dvec3(0), dvec3(5), glm::dmat3(1), .1}, {0}, Facing::inwards);
  if (random.uniform() < .5) scene.lights.environment = random_colour(random, .1, 1);
  if (random.uniform() < .3) scene.max_depth = 2 + static_cast<int>(random.uniform(0, 4));
  scene.camera = camera_at({0, 0, 0}, look, 110);
  const double scale = std::array{1.0, 1.0, 1e-3, 1e4}[static_cast<std::size_t>(seed % 4)];
  return placed(std::move(scene), {rotation(seed % 3 == 0 ? static_cast<int>(seed) : 0), scale});
}

}  // namespace proving
