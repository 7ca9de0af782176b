// Receiver x side x light x scale, rotated and moved in many ways: a spot on top of a convex solid,
// albedo / pi times the irradiance of the light (spots.cpp), which is black; or the albedo under a
// sky of 1.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/parts.h"
#include "proving/spots.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

const Rgb receiver_albedo(.5f, .75f, .875f);

struct Receiver {
  const char* name;
  void (*add)(Scene&);
};

/// Each has the origin on its top, where the normal is +y.
const Receiver receivers[] = {
    {"panel", [](Scene& scene) { scene.shapes.push_back(level(2, 0)); }},
    {"disk",
     [](Scene& scene) {
       scene.shapes.push_back({carlo::Disk{{0, 0, 0}, {0, 1, 0}, 2}});
     }},
    {"mesh",
     [](Scene& scene) {
       // The origin does not lie on the edge between the two.
       scene.shapes.push_back({carlo::Mesh{
           {{-2, 0, -2}, {-2, 0, 2.3f}, {2, 0, 1.2f}, {2, 0, -2.9f}}, {{0, 1, 2}, {0, 2, 3}}}});
     }},
    {"box",
     [](Scene& scene) {
       add_box(scene, {{0, -1, 0}, {2, 1, 2}}, {}, Facing::outwards);
     }},
    {"ball", [](Scene& scene) {
       scene.shapes.push_back(ball({0, -2, 0}, 2));
     }}};

/// Adds a light of spots.cpp, or a point, or the sky; returns radiance over albedo.
double add_light(Scene& scene, std::size_t kind) {
  const std::vector<Light> all = lights();
  if (kind < all.size()) {
    scene.shapes.push_back(lit(all[kind].shape, 1, Rgb(4)));
    return 4 * all[kind].irradiance / closed_forms::pi;
  }
  if (kind == all.size()) {
    scene.lights.points = {{{-.9f, 1.2f, 0}, Rgb(5)}};
    return 5 * .8 / (1.5 * 1.5) / closed_forms::pi;
  }
  scene.lights.environment = Rgb(1);
  return 1;
}

std::string light_name(std::size_t kind) {
  const std::vector<Light> all = lights();
  return kind < all.size() ? all[kind].name : kind == all.size() ? "point" : "sky";
}

Proof combination(const Receiver& receiver, bool two_sided, std::size_t light, double scale,
                  int number) {
  const double shift = std::array{0.0, 10.0, 1000.0}[static_cast<std::size_t>(number % 3)];
  Scene scene = empty();
  scene.materials = {number / 2 % 2 == 0 ? diffuse(receiver_albedo, two_sided)
                                         : lobeless_phong(receiver_albedo, two_sided),
                     diffuse(Rgb(0), false)};
  receiver.add(scene);
  const double factor = add_light(scene, light);
  scene.camera = spot_camera();
  std::array<double, 3> exact = exact_of(receiver_albedo);
  for (double& x : exact)
    x *= factor;
  return {fmt::format("combination/{}/{}/{}/scale={:g}/shift={:g}", receiver.name,
                      two_sided ? "two-sided" : "one-sided", light_name(light), scale, shift),
          placed(std::move(scene), {rotation(number), scale, shift * dvec3(-.4, .8, .5)}), exact,
          512, spot_rounding(shift)};
}

}  // namespace

std::vector<Proof> combination_proofs() {
  std::vector<Proof> proofs;
  int number = 60;
  for (const Receiver& receiver : receivers) {
    for (const bool two_sided : {false, true}) {
      for (std::size_t light = 0; light < lights().size() + 2; ++light) {
        for (const double scale : {1e-4, 1.0, 1e4, 1e6})
          proofs.push_back(combination(receiver, two_sided, light, scale, ++number));
      }
    }
  }
  return proofs;
}

}  // namespace proving
