#include "recap_room.h"

#include "numeric/robust.h"

#include <cmath>

namespace lab08 {
namespace {

/// The wall's radiance if it emits `emits`, reflects `from_ball` of the ball's light and the
/// fraction `again` of its own: emits + from_ball + again emits + again from_ball + ...
double series(double emits, double from_ball, double again) {
  return std::abs(again) < 1 ? (emits + from_ball) / (1 - again) : INFINITY;
}

}  // namespace

carlo::Scene RecapRoom::scene() const {
  const auto grey = [](double value) { return Rgb(static_cast<float>(value)); };
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{grey(albedo)}, false}, {carlo::Diffuse{Rgb(0)}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 2, true}, 0, grey(wall_emits)},
                  {carlo::Sphere{light().centre, light().radius}, 1, grey(ball_radiance)}};
  return scene;
}

double RecapRoom::solid_angle() const {
  return 2 * carlo::pi * (1 - std::sqrt(1 - ball * ball));
}

double RecapRoom::exact() const {
  const double F = view_factor();
  return series(wall_emits, albedo * F * ball_radiance, albedo * (1 - F));
}

double RecapRoom::light_ratio() const {
  const double p_light = 1 / solid_angle();
  return 0.5 * p_light / solid_angle();
}

double RecapRoom::non_light_ratio() const {
  const double p_light = 1 / solid_angle();
  return 0.5 * (1 - p_light) / (2 * carlo::pi - solid_angle());
}

double RecapRoom::recap_mean() const {
  const double F = view_factor();
  return series(wall_emits, light_ratio() * albedo * F * ball_radiance,
                non_light_ratio() * albedo * (1 - F));
}

double RecapRoom::random_direction_mean() const {
  const double F = view_factor(), undivided = 1 / (2 * carlo::pi);
  return series(wall_emits, undivided * albedo * F * ball_radiance, undivided * albedo * (1 - F));
}

}  // namespace lab08
