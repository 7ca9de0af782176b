#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step c: Lafortune's modified Phong BRDF. Solved.

namespace lab08 {
namespace {

float largest(Rgb c) {
  return std::max({c.r, c.g, c.b});
}

/// cos^n of the angle between unit vectors, from 1 - cos = |a - b|^2 / 2: where the vectors nearly
/// agree, their dot product may round to more than 1, which a large n amplifies.
float cos_power(Vec3 a, Vec3 b, float n) {
  const Vec3 difference = a - b;
  const float one_minus_cos = 0.5f * glm::dot(difference, difference);
  return one_minus_cos < 1 ? std::exp(n * std::log1p(-one_minus_cos)) : 0;
}

Vec3 mirrored(Vec3 normal, Vec3 wo) {
  return 2 * glm::dot(normal, wo) * normal - wo;
}

}  // namespace

// Lab 8.3 -----------------------------------------------------------------------------------------

Rgb evaluate(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  if (!(glm::dot(normal, wi) > 0)) return Rgb(0);
  const float scale = (phong.exponent + 2) / (2 * carlo::pi_f);
  return phong.kd / carlo::pi_f +
         phong.ks * (scale * cos_power(mirrored(normal, wo), wi, phong.exponent));
}

// By the largest channel: the rest is absorption, and no channel of a diffuse surface has a weight
// above 1. The reference renderer goes by the mean and absorbs nothing; either rule is unbiased.
LobeProbabilities lobe_probabilities(const carlo::Phong& phong) {
  const float diffuse = largest(phong.kd), specular = largest(phong.ks);
  const float sum = std::max(1.0f, diffuse + specular);
  return {diffuse / sum, specular / sum};
}

std::optional<BsdfSample> sample(const carlo::Phong& phong, Vec3 normal, Vec3 wo, float u_lobe,
                                 Vec2 u) {
  const LobeProbabilities chances = lobe_probabilities(phong);
  const lab07::Frame frame(normal);
  Vec3 local;
  if (u_lobe < chances.diffuse) {
    local = lab07::sample_cosine_hemisphere(u);
  } else if (u_lobe < chances.diffuse + chances.specular) {
    local = lab07::sample_mirror_lobe(u, frame.to_local(wo), phong.exponent);
  } else {
    return std::nullopt;
  }
  const Vec3 wi = glm::normalize(frame.to_world(local));
  const float density = pdf(phong, normal, wo, wi);
  if (!(density > 0)) return std::nullopt;
  return BsdfSample{wi, evaluate(phong, normal, wo, wi) * (glm::dot(normal, wi) / density),
                    density};
}

float pdf(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  const float cosine = glm::dot(normal, wi);
  if (!(cosine > 0)) return 0;
  const LobeProbabilities chances = lobe_probabilities(phong);
  const float n = phong.exponent;
  const float lobe = (n + 1) / (2 * carlo::pi_f) * cos_power(mirrored(normal, wo), wi, n);
  return chances.diffuse * cosine / carlo::pi_f + chances.specular * lobe;
}

}  // namespace lab08
