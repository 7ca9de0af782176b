#include "bsdf.h"

#include "numeric/robust.h"
#include "warp.h"

namespace renderer {
namespace {

/// The brightness that decides how often a lobe is drawn: the mean of the channels, since errors
/// count all channels alike. Any rule that gives each lobe that reflects a chance is unbiased, for
/// weights divide by the density that follows from it. Lab 8 takes the largest channel.
float brightness(Rgb c) {
  return (c.r + c.g + c.b) / 3;
}

}  // namespace

ModifiedPhong::ModifiedPhong(Rgb kd, Rgb ks, float exponent)
    : kd_(kd), ks_(ks), exponent_(exponent) {
  const float d = brightness(kd), s = brightness(ks);
  diffuse_probability_ = d + s > 0 ? d / (d + s) : 1;
}

ModifiedPhong::Value ModifiedPhong::evaluate(Vec3 normal, Vec3 wo, Vec3 wi) const {
  const float cos_i = glm::dot(normal, wi);
  if (!(cos_i > 0)) return {Rgb(0), 0};
  Value value{kd_ / pi_f, diffuse_probability_ * cosine_hemisphere_pdf(cos_i)};
  if (ks_ == Rgb(0)) return value;
  const float lobe = cos_power(wi, reflect(normal, wo), exponent_);
  value.f += ks_ * ((exponent_ + 2) / (2 * pi_f) * lobe);
  value.pdf += (1 - diffuse_probability_) * lobe_pdf(lobe, exponent_);
  return value;
}

std::optional<ModifiedPhong::Sample> ModifiedPhong::sample(Vec3 normal, Vec3 wo, float u_lobe,
                                                           Vec2 u) const {
  if (ks_ == Rgb(0)) {
    const Vec3 local = sample_cosine_hemisphere(u);
    if (!(local.z > 0)) return std::nullopt;
    // f cos / pdf with the cosine cancelled by hand: no division by a cosine of 0.
    return Sample{glm::normalize(Frame(normal).to_world(local)), kd_,
                  cosine_hemisphere_pdf(local.z)};
  }
  const bool diffuse = u_lobe < diffuse_probability_;
  const Vec3 axis = diffuse ? normal : reflect(normal, wo);
  const Vec3 local = diffuse ? sample_cosine_hemisphere(u) : sample_lobe(u, exponent_);
  const Vec3 wi = glm::normalize(Frame(glm::normalize(axis)).to_world(local));
  const Value value = evaluate(normal, wo, wi);
  if (!(value.pdf > 0)) return std::nullopt;
  return Sample{wi, value.f * (glm::dot(normal, wi) / value.pdf), value.pdf};
}

Refraction refract(Vec3 normal, Vec3 wo, float eta) {
  const float cos_o = std::min(1.0f, glm::dot(normal, wo));
  const float sin2_t = eta * eta * (1 - cos_o * cos_o);
  if (!(sin2_t < 1)) return {1, std::nullopt, eta};
  const float cos_t = std::sqrt(1 - sin2_t);
  const float parallel = (cos_o - eta * cos_t) / (cos_o + eta * cos_t);
  const float perpendicular = (eta * cos_o - cos_t) / (eta * cos_o + cos_t);
  const Vec3 wt = glm::normalize(-eta * wo + (eta * cos_o - cos_t) * normal);
  return {0.5f * (parallel * parallel + perpendicular * perpendicular), wt, eta};
}

}  // namespace renderer
