#include "scene/fingerprint.h"

#include <catch2/catch_test_macros.hpp>

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace carlo;

Scene any_scene() {
  Scene s;
  s.width = 37;
  s.height = 21;
  s.materials = {{Diffuse{}, false}, {Phong{}, true}};
  s.shapes = {{Sphere{{0, 0, 0}, 1}, 0, Rgb(1)}};
  s.lights.points = {{{1, 2, 3}, Rgb(4)}};
  return s;
}

TEST_CASE("A fingerprint depends on all that an image depends on, and on nothing else") {
  const std::string before = fingerprint(any_scene());
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.width = 38; },
      [](Scene& s) { s.camera.origin.x += 1; },
      [](Scene& s) { s.camera.tan_half_y += 1; },
      [](Scene& s) { s.sampler = SamplerKind::independent; },
      [](Scene& s) { s.max_depth = 3; },
      [](Scene& s) { s.materials[0].two_sided = true; },
      [](Scene& s) { s.materials[0].model = Mirror{}; },
      [](Scene& s) { std::get<Phong>(s.materials[1].model).exponent = 31; },
      [](Scene& s) { std::get<Sphere>(s.shapes[0].geometry).radius = 2; },
      [](Scene& s) {
        s.shapes[0].geometry = Mesh{{Vec3(0), Vec3(1)}, {}};
      },
      [](Scene& s) { s.shapes.push_back(s.shapes[0]); },
      [](Scene& s) { s.lights.points[0].intensity.g = 5; },
      [](Scene& s) { s.lights.environment = Rgb(1); },
      [](Scene& s) { s.lights.envmap = Envmap{Image(2, 1)}; },
  };
  for (const auto& change : changes) {
    Scene s = any_scene();
    change(s);
    CHECK(fingerprint(s) != before);
  }
  // And on an environment map's pixels and rotation.
  const auto under_sky = [](float texel, double turn) {
    Scene s = any_scene();
    Envmap map{Image(2, 1), glm::dmat3(turn, 0, 0, 0, 1, 0, 0, 0, turn)};
    map.image.at(1, 0).g = texel;
    s.lights.envmap = map;
    return fingerprint(s);
  };
  CHECK(under_sky(1, 1) == under_sky(1, 1));
  CHECK(under_sky(1, 1) != under_sky(2, 1));
  CHECK(under_sky(1, 1) != under_sky(1, -1));
  Scene s = any_scene();
  s.spp = 1000;
  s.notes = {"a note"};
  CHECK(fingerprint(s) == before);
}

}  // namespace
