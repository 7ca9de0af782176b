#include "path_tracer.h"

#include <cmath>

// Lab 08, step g: mirrors and glass. Solved.

namespace lab08 {
namespace {

Vec3 mirrored(Vec3 normal, Vec3 wo) {
  return glm::normalize(2 * glm::dot(normal, wo) * normal - wo);
}

/// sin^2 of the refracted angle.
float sin2_beyond(float cos_i, float eta) {
  return eta * eta * (1 - cos_i * cos_i);
}

}  // namespace

// Lab 8.7 -----------------------------------------------------------------------------------------

float fresnel(float cos_i, float eta) {
  const float sin2_t = sin2_beyond(cos_i, eta);
  if (sin2_t >= 1) return 1;
  const float cos_t = std::sqrt(1 - sin2_t);
  const float parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const float perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

std::optional<Vec3> refract(Vec3 normal, Vec3 wo, float eta) {
  const float cos_o = glm::dot(normal, wo);
  const float sin2_t = sin2_beyond(cos_o, eta);
  if (sin2_t >= 1) return std::nullopt;
  return glm::normalize((eta * cos_o - std::sqrt(1 - sin2_t)) * normal - eta * wo);
}

BsdfSample sample_mirror(const carlo::Mirror& mirror, const Surface& surface) {
  return {mirrored(surface.n, surface.wo), mirror.reflectance, 0};
}

BsdfSample sample_glass(const carlo::Dielectric& glass, const Surface& surface, float u) {
  const float eta = surface.front ? glass.ext_ior / glass.int_ior : glass.int_ior / glass.ext_ior;
  const auto beyond = refract(surface.n, surface.wo, eta);
  if (!beyond || u < fresnel(glm::dot(surface.n, surface.wo), eta)) {
    return {mirrored(surface.n, surface.wo), Rgb(1), 0};
  }
  return {*beyond, Rgb(eta * eta), 0};
}

Rgb trace_specular(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return world.environment();
  Rgb radiance = with_emission ? surface->Le : Rgb(0);
  std::optional<BsdfSample> next;
  const auto* phong = std::get_if<carlo::Phong>(surface->material);
  if (phong != nullptr) {
    const auto f = [&](Vec3 wi) { return evaluate(*phong, surface->n, surface->wo, wi); };
    radiance += direct_by_area(world, *surface, f, rng);
    const float u_lobe = rng.uniform_float();
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    next = sample(*phong, surface->n, surface->wo, u_lobe, {u, v});
  } else if (const auto* mirror = std::get_if<carlo::Mirror>(surface->material)) {
    next = sample_mirror(*mirror, *surface);
  } else {
    next = sample_glass(std::get<carlo::Dielectric>(*surface->material), *surface,
                        rng.uniform_float());
  }
  if (!next) return radiance;
  const Ray onwards = world.leave(*surface, next->wi);
  return radiance + next->weight * trace_specular(world, onwards, phong == nullptr, rng);
}

}  // namespace lab08
