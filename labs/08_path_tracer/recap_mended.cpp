#include "recap.h"
#include "support/error.h"

// The Recap with four changes. Emission is added, not chosen. Each ray is divided by its density.
// One of the two rays is traced, divided by the probability of the choice. And that choice includes
// the roulette: where sample() would end the path, the light is sampled instead, so a non-light ray
// continues with the probability that absorption leaves and a weight of about 1, and products of
// weights do not grow.

namespace lab08 {
namespace {

class Mended {
 public:
  Mended(const World& world, const BallLight& light, int most_calls, Rng& rng)
      : world_(world), light_(light), most_calls_(most_calls), rng_(rng) {}

  RecapPath path(const Ray& ray) {
    const Rgb radiance = trace_path(ray);
    return {radiance, calls_, cut_};
  }

 private:
  Rgb trace_path(const Ray& ray) {
    if (calls_ == most_calls_) {
      cut_ = true;
      return Rgb(0);
    }
    ++calls_;
    const auto met = world_.intersect(ray);
    if (!met) return world_.environment();
    const carlo::Phong& phong = met->phong();
    if (phong.kd == Rgb(0) && phong.ks == Rgb(0)) return met->Le;
    return met->Le + reflected(*met, phong);
  }

  /// One branch: a light ray with probability p_light, otherwise the direction of sample() if that
  /// is not a light ray.
  Rgb reflected(const Surface& surface, const carlo::Phong& phong) {
    const auto [diffuse, specular] = lobe_probabilities(phong);
    const float goes_on = diffuse + specular;
    const float p_light = 1 - goes_on;
    if (!(p_light > 0)) {
      throw carlo::Error(
          "the mended Recap samples the light with the probability of absorption; "
          "this surface absorbs nothing");
    }
    const Cone light = light_.seen_from(surface.p);
    const float u_branch = rng_.uniform_float();
    const float u = rng_.uniform_float();
    const float v = rng_.uniform_float();
    if (u_branch >= goes_on) return light_ray(surface, light, {u, v}) / p_light;
    const auto next = sample(phong, surface.n, surface.wo, u_branch, {u, v});
    // Geometry decides, not what the ray would meet: directions inside the cone belong to the light
    // ray even behind a pillar.
    if (!next || light.contains(next->wi)) return Rgb(0);
    return next->weight * trace_path(world_.leave(surface, next->wi));
  }

  /// The part of the integral over the light's cone; its density there is 1 over the solid angle.
  /// Includes all radiance from whatever the ray meets, light or pillar.
  Rgb light_ray(const Surface& surface, const Cone& light, Vec2 u) {
    const Vec3 wi = light.sample(u);
    const float above = glm::dot(surface.n, wi);
    if (above <= 0) return Rgb(0);
    const Rgb f_r = evaluate(surface.phong(), surface.n, surface.wo, wi);
    return light.solid_angle() * above * f_r * trace_path(world_.leave(surface, wi));
  }

  const World& world_;
  const BallLight& light_;
  int most_calls_;
  Rng& rng_;
  int calls_ = 0;
  bool cut_ = false;
};

}  // namespace

RecapPath recap_mended(const World& world, const BallLight& light, const Ray& ray, int most_calls,
                       Rng& rng) {
  return Mended(world, light, most_calls, rng).path(ray);
}

}  // namespace lab08
