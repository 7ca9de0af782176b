#include "bias.h"

// Lab 09, step e: radiance from photons. Solved.

namespace lab09 {
namespace {

/// The area of the disc on which the photons in a sphere about the point are assumed to lie.
float disc(float radius2) {
  return carlo::pi_f * radius2;
}

/// The contribution of a photon to the radiance towards wo, times the area over which its flux is
/// spread.
Rgb reflected(const Photon& photon, const Surface& surface, const Brdf& f) {
  // No cosine: the density of photons already accounts for it.
  return glm::dot(photon.wi, surface.n) > 0 ? f(photon.wi) * photon.flux : Rgb(0);
}

Rgb phong_radiance_within(const PhotonMap& map, const Surface& surface, float radius) {
  const auto f = [&](Vec3 wi) {
    return lab08::evaluate(surface.phong(), surface.n, surface.wo, wi);
  };
  return radiance_within(map, surface, f, radius);
}

/// The direction sampled at a mirror or glass; nothing for Phong surfaces.
std::optional<lab08::BsdfSample> sample_specular(const Surface& surface, Rng& rng) {
  if (const auto* mirror = std::get_if<carlo::Mirror>(surface.material))
    return lab08::sample_mirror(*mirror, surface);
  if (const auto* glass = std::get_if<carlo::Dielectric>(surface.material))
    return lab08::sample_glass(*glass, surface, rng.uniform_float());
  return std::nullopt;
}

std::optional<lab08::BsdfSample> sample_phong(const Surface& surface, Rng& rng) {
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  return lab08::sample(surface.phong(), surface.n, surface.wo, u_lobe, {u, v});
}

Rgb direct(const World& world, const Surface& surface, Rng& rng) {
  const auto f = [&](Vec3 wi) {
    return lab08::evaluate(surface.phong(), surface.n, surface.wo, wi);
  };
  return lab08::direct_by_area(world, surface, f, rng);
}

}  // namespace

// Lab 9.5 -----------------------------------------------------------------------------------------

Rgb radiance_within(const PhotonMap& map, const Surface& surface, const Brdf& f, float radius) {
  Rgb sum(0);
  map.within(surface.p, radius,
             [&](const Photon& photon, float) { sum += reflected(photon, surface, f); });
  return sum / disc(radius * radius);
}

Rgb radiance_nearest(const PhotonMap& map, const Surface& surface, const Brdf& f, int k) {
  const std::vector<const Photon*> photons = map.nearest(surface.p, k);
  if (photons.size() < static_cast<std::size_t>(k)) return Rgb(0);
  Rgb sum(0);
  for (const Photon* photon : std::span(photons).first(photons.size() - 1))
    sum += reflected(*photon, surface, f);
  const Vec3 farthest = photons.back()->p - surface.p;
  return sum / disc(glm::dot(farthest, farthest));
}

Rgb photon_radiance(const World& world, const Ray& ray, const PhotonMap& all, float radius,
                    Rng& rng) {
  Ray next_ray = ray;
  Rgb beta(1), radiance(0);
  for (int segment = 0; segment < lab08::longest_path; ++segment) {
    const auto surface = world.intersect(next_ray);
    if (!surface) return radiance + beta * world.environment();
    radiance += beta * surface->Le;
    const auto next = sample_specular(*surface, rng);
    if (!next) return radiance + beta * phong_radiance_within(all, *surface, radius);
    beta *= next->weight;
    next_ray = world.leave(*surface, next->wi);
  }
  return radiance;
}

Rgb caustic_radiance(const World& world, const Ray& ray, const PhotonMap& caustics, float radius,
                     Rng& rng) {
  Ray next_ray = ray;
  Rgb beta(1), radiance(0);
  bool with_emission = true;  // until the first Phong surface
  for (int segment = 0; segment < lab08::longest_path; ++segment) {
    const auto surface = world.intersect(next_ray);
    if (!surface) return radiance + beta * world.environment();
    if (with_emission) radiance += beta * surface->Le;
    auto next = sample_specular(*surface, rng);
    if (!next) {
      // From here on light sources seen straight are direct light, and those seen through mirrors
      // and glass are caustics.
      with_emission = false;
      radiance += beta * direct(world, *surface, rng);
      radiance += beta * phong_radiance_within(caustics, *surface, radius);
      next = sample_phong(*surface, rng);
      if (!next) return radiance;
    }
    beta *= next->weight;
    next_ray = world.leave(*surface, next->wi);
  }
  return radiance;
}

}  // namespace lab09
