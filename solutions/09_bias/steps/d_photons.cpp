#include "bias.h"
#include "hemisphere.h"
#include "numeric/robust.h"

#include <cmath>

// Lab 09, step d: photons. Solved.

namespace lab09 {
namespace {

/// The radiance of a light is the same everywhere on it.
Rgb power(const Light& light) {
  return carlo::pi_f * light.area() * light.sample({0.5f, 0.5f}).radiance;
}

/// The next direction of a photon from a surface, and the part of its flux that continues.
std::optional<lab08::BsdfSample> scatter(const Surface& surface, Rng& rng) {
  if (const auto* mirror = std::get_if<carlo::Mirror>(surface.material))
    return lab08::sample_mirror(*mirror, surface);
  if (const auto* glass = std::get_if<carlo::Dielectric>(surface.material)) {
    lab08::BsdfSample next = lab08::sample_glass(*glass, surface, rng.uniform_float());
    // Refraction changes radiance with its solid angle, but not the flux of a photon.
    next.weight = Rgb(1);
    return next;
  }
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  return lab08::sample(surface.phong(), surface.n, surface.wo, u_lobe, {u, v});
}

}  // namespace

// Lab 9.4 -----------------------------------------------------------------------------------------

Emission emit_from_point(Vec3 p, Rgb intensity, Rng& rng) {
  const float z = 1 - 2 * rng.uniform_float();
  const float phi = 2 * carlo::pi_f * rng.uniform_float();
  const float r = carlo::safe_sqrt(1 - z * z);
  return {{p, {r * std::cos(phi), r * std::sin(phi), z}}, 4 * carlo::pi_f * intensity};
}

Emission emit_from_light(const Light& light, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const lab08::LightPoint point = light.sample({u, v});
  const float s = rng.uniform_float();
  const float t = rng.uniform_float();
  const Vec3 local = lab07::sample_cosine_hemisphere({s, t});
  const Vec3 d = glm::normalize(lab07::Frame(point.n).to_world(local));
  return {leave(point, d), power(light)};
}

Emission emit_photon(const World& world, Rng& rng) {
  const Light& light = world.choose(rng.uniform());
  Emission emission = emit_from_light(light, rng);
  emission.flux /= light.chance();
  return emission;
}

void trace_photon(const World& world, const Emission& emission, Rng& rng,
                  const std::function<void(const Photon&)>& store) {
  Ray ray = emission.ray;
  Photon photon;
  photon.flux = emission.flux;
  for (int segment = 0; segment < lab08::longest_path; ++segment) {
    const auto surface = world.intersect(ray);
    if (!surface) return;
    const bool phong = std::holds_alternative<carlo::Phong>(*surface->material);
    if (phong) {
      photon.p = surface->p;
      photon.wi = surface->wo;
      store(photon);
    }
    const auto next = scatter(*surface, rng);
    if (!next) return;
    ++(phong ? photon.phong : photon.specular);
    photon.flux *= next->weight;
    ray = world.leave(*surface, next->wi);
  }
}

}  // namespace lab09
