// A strong light and a weak one, for every two kinds, over one spot of a floor. The choice of the
// light must not affect the result: the strong one may be as far away as it is strong (a sun and a
// light source), or hidden, or below the floor, so that the weak one is the only light.
//
// Exact: albedo / pi times the sum of irradiances (lights_of_all_kinds.h). A light that surrounds
// the scene loses what other shapes cover.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/lights_of_all_kinds.h"
#include "proving/parts.h"
#include "proving/spots.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

constexpr double pair_albedo = .5;

/// Both are out of the line of sight and of each other's way: 50 degrees apart, each 11 wide.
const dvec3 toward_weak(-.6, .8, 0), toward_strong(0, .8, -.6);

/// Material 1 is black. Two segments exclude light that the floor reflects onto cards.
Scene pair_scene(bool two_sided) {
  Scene scene = empty();
  scene.materials = {diffuse(Rgb(pair_albedo), two_sided), diffuse(Rgb(0), true)};
  scene.shapes = {level(50, 0)};
  scene.camera = spot_camera();
  scene.max_depth = 2;
  return scene;
}

/// Where the strong light hardly contributes, the other may get only 1/48 of the samples, with 7
/// times the mean as standard deviation: 1.9e5 samples give 1.6 %.
constexpr std::uint32_t few = 512, many = 3072;

Proof pair_proof(std::string name, Scene scene, double irradiance, std::uint32_t spp, int number) {
  // Half of the scenes list their shapes in reverse order; positions and rotations vary, too.
  if (number % 2 == 1) std::reverse(scene.shapes.begin(), scene.shapes.end());
  const bool turned = number % 3 == 2;
  Proof proof{"pairs/" + std::move(name),
              placed(std::move(scene), {rotation(turned ? number : 0), turned ? 3.7 : 1}),
              exact_of(pair_albedo * irradiance / closed_forms::pi), spp};
  proof.rounding = 2e-5;
  return proof;
}

std::string pair_name(const char* how, LightKind strong, LightKind weak, double ratio) {
  return fmt::format("{}/{} and {}/ratio={:g}", how, name_of(strong), name_of(weak), ratio);
}

/// Two infinitely distant lights of one kind are indistinguishable; nothing is seen behind a room.
bool makes_a_pair(LightKind strong, LightKind weak) {
  return weak != LightKind::room && !(surrounds(strong) && surrounds(weak));
}

/// The strong light shines `ratio` times as much from sqrt(ratio) times as far away: both
/// contribute equally at the origin. Of the surrounding lights only a room grows.
void sun_and_light(std::vector<Proof>& proofs, LightKind strong, LightKind weak, double ratio,
                   int number) {
  if (!makes_a_pair(strong, weak)) return;
  Scene scene = pair_scene(number % 4 < 2);
  const AddedLight light = add_light(scene, weak, {toward_weak, 1}, 1);
  const AddedLight sun = add_light(scene, strong, {toward_strong, std::sqrt(ratio)}, 1);
  double sum = light.irradiance + sun.irradiance;
  if (surrounds(strong)) sum -= sun.irradiance * light.covers / closed_forms::pi;
  if (surrounds(weak)) sum -= light.irradiance * sun.covers / closed_forms::pi;
  proofs.push_back(
      pair_proof(pair_name("both", strong, weak, ratio), std::move(scene), sum, few, number));
}

/// The strong light is hidden: by a card, or, if it surrounds the scene, by a black box around it.
void hidden(std::vector<Proof>& proofs, LightKind strong, LightKind weak, double ratio,
            int number) {
  if (!makes_a_pair(strong, weak)) return;
  Scene scene = pair_scene(number % 4 < 2);
  const AddedLight light = add_light(scene, weak, {toward_weak, 1}, 1);
  const Stand stand{toward_strong, 1};
  add_light(scene, strong, stand, ratio);
  double sum = light.irradiance;
  if (surrounds(strong)) {
    add_box(scene, {{0, 0, 0}, {1.5, 1.5, 1.5}, glm::dmat3(1), .1}, {1}, Facing::inwards);
  } else {
    const double covers = add_card(scene, stand);
    if (surrounds(weak)) sum -= light.irradiance * covers / closed_forms::pi;
  }
  proofs.push_back(
      pair_proof(pair_name("hidden", strong, weak, ratio), std::move(scene), sum, many, number));
}

/// The strong light is behind the floor; an image is bright only from 45 degrees below the horizon
/// on.
void below(std::vector<Proof>& proofs, LightKind strong, LightKind weak, double ratio, int number) {
  if (!makes_a_pair(strong, weak)) return;
  if (strong == LightKind::room || strong == LightKind::sky) return;
  Scene scene = pair_scene(number % 4 < 2);
  const AddedLight light = add_light(scene, weak, {toward_weak, 1}, 1);
  if (strong == LightKind::image) {
    scene.lights.envmap = image_of([](int, int row) { return Rgb(row < 3 ? 0 : 1); });
    for (Rgb& texel : scene.lights.envmap->image.pixels)
      texel *= static_cast<float>(ratio);
  } else {
    add_light(scene, strong, {-toward_strong, 1}, ratio);
  }
  proofs.push_back(pair_proof(pair_name("below", strong, weak, ratio), std::move(scene),
                              light.irradiance, many, number));
}

}  // namespace

std::vector<Proof> light_pair_proofs() {
  std::vector<Proof> proofs;
  int number = 0;
  for (const LightKind strong : light_kinds) {
    for (const LightKind weak : light_kinds) {
      for (const double ratio : {1.0, 1e4, 1e8, 1e12})
        sun_and_light(proofs, strong, weak, ratio, ++number);
      for (const double ratio : {1.0, 1e6, 1e12}) {
        hidden(proofs, strong, weak, ratio, ++number);
        below(proofs, strong, weak, ratio, ++number);
      }
    }
  }
  return proofs;
}

}  // namespace proving
