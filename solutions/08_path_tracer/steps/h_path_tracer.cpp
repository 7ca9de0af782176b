#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step h: the path tracer, in a loop, with all the techniques that reduce its error.
// Solved.

namespace lab08 {
namespace {

/// The state of a path.
struct Path {
  Ray ray;
  Rgb beta{1};  ///< throughput: the factor of radiance from here
  Rgb radiance{0};
  float pdf = 0;                ///< of the ray's direction, if the light was sampled as well
  std::optional<Surface> last;  ///< the surface that the ray left in that case; none: emission
                                ///< counts fully
};

/// Direct light from a sampled point of a light, weighted against sample()'s directions.
Rgb direct(const World& world, const Surface& surface, Dimensions& dimensions) {
  if (world.lights().empty()) return Rgb(0);
  const Light& light = world.choose(dimensions.next_1d());
  const Vec2 u = dimensions.next_2d();
  const LightPoint point = light.sample(u);
  const Vec3 d = point.p - surface.p;
  const float distance2 = glm::dot(d, d);
  const Vec3 wi = d / std::sqrt(distance2);
  const float cos_surface = glm::dot(surface.n, wi), cos_light = -glm::dot(point.n, wi);
  if (!(cos_surface > 0 && cos_light > 0) || !world.sees(surface, point)) return Rgb(0);
  const float density = distance2 * light.chance() / (cos_light * light.area());
  const Rgb f = evaluate(surface.phong(), surface.n, surface.wo, wi);
  const float other = pdf(surface.phong(), surface.n, surface.wo, wi);
  return f * point.radiance * (cos_surface * power_heuristic(density, other) / density);
}

Rgb emitted(const World& world, const Path& path, const Surface& surface) {
  if (!path.last) return surface.Le;
  return surface.Le * power_heuristic(path.pdf, light_pdf(world, *path.last, surface));
}

/// The direction in which the path continues from a surface; nothing if it ends there.
std::optional<BsdfSample> scatter(const World& world, Path& path, const Surface& surface,
                                  unsigned place, Dimensions& dimensions) {
  dimensions.seek(place + lobe_dimension);
  if (const auto* mirror = std::get_if<carlo::Mirror>(surface.material)) {
    path.last.reset();
    return sample_mirror(*mirror, surface);
  }
  if (const auto* glass = std::get_if<carlo::Dielectric>(surface.material)) {
    path.last.reset();
    return sample_glass(*glass, surface, dimensions.next_1d());
  }
  const float u_lobe = dimensions.next_1d();
  const Vec2 u = dimensions.next_2d();
  dimensions.seek(place + light_dimension);
  path.radiance += path.beta * direct(world, surface, dimensions);
  path.last = surface;
  return sample(surface.phong(), surface.n, surface.wo, u_lobe, u);
}

/// The survival probability in roulette. A number below 1e-9 is drawn 60 times too often, since u
/// is a multiple of 2^-24; so no path that can contribute gets a probability below 1/64.
float survival_of(Rgb beta) {
  const float most = std::max({beta.r, beta.g, beta.b});
  return most > 0 ? std::max(4 * most, 1 / 64.0f) : 0;
}

}  // namespace

// Lab 8.8 -----------------------------------------------------------------------------------------

float power_heuristic(float p, float q) {
  const float ratio = q / p;
  return 1 / (1 + ratio * ratio);
}

float light_pdf(const World& world, const Surface& from, const Surface& to) {
  const Light* light = world.light_of(to);
  if (light == nullptr || to.Le == Rgb(0)) return 0;
  const Vec3 d = to.p - from.p;
  const float distance2 = glm::dot(d, d);
  const float cos_light = glm::dot(to.n, to.wo);
  return distance2 * light->chance() / (cos_light * light->area());
}

Rgb path_radiance(const World& world, const Ray& ray, int max_depth, Dimensions& dimensions) {
  Path path;
  path.ray = ray;
  unsigned place = film_dimensions;
  for (int depth = 1;; ++depth, place += vertex_dimensions) {
    const auto surface = world.intersect(path.ray);
    if (!surface) return path.radiance + path.beta * world.environment();
    path.radiance += path.beta * emitted(world, path, *surface);
    if (depth == max_depth || depth == longest_path) return path.radiance;
    const auto next = scatter(world, path, *surface, place, dimensions);
    if (!next) return path.radiance;
    path.beta *= next->weight;
    path.pdf = next->pdf;
    path.ray = world.leave(*surface, next->wi);
    const float survival = survival_of(path.beta);
    if (survival >= 1) continue;
    dimensions.seek(place + roulette_dimension);
    if (!(dimensions.next_1d() < survival)) return path.radiance;
    path.beta /= survival;
  }
}

}  // namespace lab08
