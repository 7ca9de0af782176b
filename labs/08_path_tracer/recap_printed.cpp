#include "hemisphere.h"
#include "numeric/robust.h"
#include "recap.h"

// The lecture's own lines stand as comments above their translations.

namespace lab08 {
namespace {

/// A uniform direction of the hemisphere.
Vec3 random_direction(Vec3 normal, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  return lab07::Frame(normal).to_world(lab07::sample_uniform_hemisphere({u, v}));
}

class AsPrinted {
 public:
  AsPrinted(const World& world, const BallLight& light, int most_calls, Rng& rng)
      : world_(world), light_(light), most_calls_(most_calls), rng_(rng) {}

  RecapPath path(bool recap, const Ray& ray) {
    recap_ = recap;
    const Rgb radiance = trace_path(ray);
    return {radiance, calls_, cut_};
  }

 private:
  // TracePath(p, d) returns (r,g,b):
  Rgb trace_path(const Ray& ray) {
    if (calls_ == most_calls_) {  // ours
      cut_ = true;
      return Rgb(0);
    }
    ++calls_;
    // Trace ray (p, d) to find nearest intersection p'
    const auto surface = world_.intersect(ray);
    if (!surface) return world_.environment();  // ours
    // If Le = (0,0,0) then p_emit = 0 else if f_r = (0,0,0) then p_emit = 1 else p_emit = .9
    const float p_emit = lab08::p_emit(*surface);
    // If random() < p_emit then: return (1/p_emit) * (Le_red, Le_green, Le_blue)
    if (rng_.uniform_float() < p_emit) return (1 / p_emit) * surface->Le;
    // return (1/(1-p_emit)) * ...
    return (1 / (1 - p_emit)) * (recap_ ? light_and_non_light(*surface) : one_ray(*surface));
  }

  /// Before the Recap.
  Rgb one_ray(const Surface& surface) {
    // generate ray in random direction d'
    return reflected(surface, random_direction(surface.n, rng_));
  }

  /// In the Recap.
  Rgb light_and_non_light(const Surface& surface) {
    const Cone light = light_.seen_from(surface.p);
    const float p_light = 1 / light.solid_angle();
    // generate ray in random direction d' towards a light
    const float u = rng_.uniform_float();
    const float v = rng_.uniform_float();
    Vec3 d = light.sample({u, v});
    // L_r = (1/2 * p_light) * f_r(d -> d') * (n . d') * TracePath(p', d')
    Rgb L_r = (0.5f * p_light) * reflected(surface, d);
    // generate ray in random direction d' not towards the light
    d = random_direction(surface.n, rng_);
    while (light.contains(d))
      d = random_direction(surface.n, rng_);
    // L_r += (1/2 * (1 - p_light)) * f_r(d -> d') * (n . d') * TracePath(p', d')
    L_r += (0.5f * (1 - p_light)) * reflected(surface, d);
    return L_r;
  }

  /// f_r(d -> d') * (n . d') * TracePath(p', d'); 0 for the part of the light below the horizon.
  Rgb reflected(const Surface& surface, Vec3 d) {
    const float n_d = glm::dot(surface.n, d);
    if (n_d <= 0) return Rgb(0);
    const Rgb f_r = evaluate(surface.phong(), surface.n, surface.wo, d);
    return f_r * n_d * trace_path(world_.leave(surface, d));
  }

  const World& world_;
  const BallLight& light_;
  int most_calls_;
  Rng& rng_;
  bool recap_ = false;
  int calls_ = 0;
  bool cut_ = false;
};

}  // namespace

RecapPath random_direction_as_printed(const World& world, const BallLight& light, const Ray& ray,
                                      int most_calls, Rng& rng) {
  return AsPrinted(world, light, most_calls, rng).path(false, ray);
}

RecapPath recap_as_printed(const World& world, const BallLight& light, const Ray& ray,
                           int most_calls, Rng& rng) {
  return AsPrinted(world, light, most_calls, rng).path(true, ray);
}

}  // namespace lab08
