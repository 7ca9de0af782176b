#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

// Lab 08, step e: one ray to the light and one elsewhere. Solved.

namespace lab08 {
namespace {

/// f incoming cos(theta) for a direction of density 1 / measure.
Rgb contribution(Vec3 wi, float measure, Vec3 normal, const Brdf& f, const Incoming& incoming) {
  const float cosine = glm::dot(normal, wi);
  if (!(cosine > 0)) return Rgb(0);
  return f(wi) * incoming(wi) * (cosine * measure);
}

Rgb to_light(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  return contribution(light.sample({u, v}), light.solid_angle(), normal, f, incoming);
}

Rgb elsewhere(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming, Rng& rng) {
  const lab07::Frame frame(normal);
  Vec3 wi;
  do {
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    wi = frame.to_world(lab07::sample_uniform_hemisphere({u, v}));
  } while (light.contains(wi));
  const float measure = 2 * carlo::pi_f - light.solid_angle_above(normal);
  return contribution(wi, measure, normal, f, incoming);
}

}  // namespace

// Lab 8.5 -----------------------------------------------------------------------------------------

Rgb reflect_split(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                  Rng& rng) {
  const Rgb from_light = to_light(light, normal, f, incoming, rng);
  return from_light + elsewhere(light, normal, f, incoming, rng);
}

Rgb reflect_split_one(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                      Rng& rng) {
  if (rng.uniform_float() < 0.5f) return 2.0f * to_light(light, normal, f, incoming, rng);
  return 2.0f * elsewhere(light, normal, f, incoming, rng);
}

}  // namespace lab08
