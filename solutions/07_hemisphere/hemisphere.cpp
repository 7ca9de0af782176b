#include "hemisphere.h"

#include "bins.h"
#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

// Lab 07: directions, solved.

namespace lab07 {

using carlo::pi_f;

// Lab 7.1 -----------------------------------------------------------------------------------------

// Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017: the terms of the
// denominator have the same sign, and their sum is never smaller than 1 in size.
Frame::Frame(Vec3 normal) : s(0), t(0), n(normal) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t = {b, sign + n.y * n.y * a, -n.y};
}

Vec3 Frame::to_world(Vec3 local) const {
  return local.x * s + local.y * t + local.z * n;
}

Vec3 Frame::to_local(Vec3 world) const {
  return {glm::dot(world, s), glm::dot(world, t), glm::dot(world, n)};
}

// Lab 7.2 -----------------------------------------------------------------------------------------

Accepted sample_uniform_by_rejection(Vec3 normal, carlo::Rng& rng) {
  for (std::int64_t darts = 1;; ++darts) {
    const float x = 2 * rng.uniform_float() - 1;
    const float y = 2 * rng.uniform_float() - 1;
    const float z = 2 * rng.uniform_float() - 1;
    const Vec3 dart(x, y, z);
    const float length2 = glm::dot(dart, dart);
    if (length2 > 1 || length2 == 0) continue;
    const Vec3 w = dart / std::sqrt(length2);
    return {glm::dot(w, normal) < 0 ? -w : w, darts};
  }
}

// Lab 7.3 -----------------------------------------------------------------------------------------

namespace {

/// The direction with this cosine and sine of its angle with z, at azimuth 2 pi u.
Vec3 spherical(float cosine, float sine, float u) {
  const float phi = 2 * pi_f * u;
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

}  // namespace

Vec3 sample_uniform_hemisphere(Vec2 u) {
  return spherical(1 - u.x, std::sqrt(u.x * (2 - u.x)), u.y);
}

float uniform_hemisphere_pdf(Vec3 w) {
  return w.z < 0 ? 0 : 1 / (2 * pi_f);
}

// Lab 7.4 -----------------------------------------------------------------------------------------

Vec3 sample_cosine_hemisphere(Vec2 u) {
  return spherical(std::sqrt(1 - u.x), std::sqrt(u.x), u.y);
}

float cosine_hemisphere_pdf(Vec3 w) {
  return std::max(0.0f, w.z) / pi_f;
}

// Lab 7.5 -----------------------------------------------------------------------------------------

Vec3 sample_lobe(Vec2 u, float n) {
  const float log_cos = std::log1p(-u.x) / (n + 1);
  return spherical(std::exp(log_cos), std::sqrt(-std::expm1(2 * log_cos)), u.y);
}

// cos = (1 + tan^2)^(-1/2): the tangent is accurate for small angles, where the cosine rounds to 1,
// and for large ones, where the sine does.
float lobe_pdf(Vec3 w, float n) {
  if (!(w.z > 0)) return 0;
  const float tangent = std::hypot(w.x, w.y) / w.z;
  const float log_cos = -0.5f * std::log1p(tangent * tangent);
  return (n + 1) / (2 * pi_f) * (n == 0 ? 1 : std::exp(n * log_cos));
}

// Lab 7.6 -----------------------------------------------------------------------------------------

Vec3 mirror_direction(Vec3 wo) {
  return {-wo.x, -wo.y, wo.z};
}

Vec3 sample_mirror_lobe(Vec2 u, Vec3 wo, float n) {
  return Frame(mirror_direction(wo)).to_world(sample_lobe(u, n));
}

float mirror_lobe_pdf(Vec3 wi, Vec3 wo, float n) {
  return lobe_pdf(Frame(mirror_direction(wo)).to_local(wi), n);
}

// Lab 7.7 -----------------------------------------------------------------------------------------

namespace {

/// A direction and cos(theta) / pdf, the weight of the radiance from there; 0 below the horizon.
struct Weighted {
  Vec3 wi;
  float weight;
};

Weighted draw(const Sampling& sampling, const Frame& frame, carlo::Rng& rng) {
  if (sampling.technique == Technique::rejection) {
    const Vec3 wi = sample_uniform_by_rejection(frame.n, rng).w;
    return {wi, 2 * pi_f * glm::dot(wi, frame.n)};
  }
  const float x = rng.uniform_float();
  const float y = rng.uniform_float();
  if (sampling.technique == Technique::uniform) {
    const Vec3 wi = sample_uniform_hemisphere({x, y});
    return {frame.to_world(wi), 2 * pi_f * wi.z};
  }
  if (sampling.technique == Technique::cosine) {
    return {frame.to_world(sample_cosine_hemisphere({x, y})), pi_f};
  }
  const Vec3 wo = frame.to_local(sampling.wo);
  const Vec3 wi = sample_mirror_lobe({x, y}, wo, sampling.n);
  const float pdf = mirror_lobe_pdf(wi, wo, sampling.n);
  return {frame.to_world(wi), wi.z > 0 && pdf > 0 ? wi.z / pdf : 0};
}

}  // namespace

double irradiance(const Radiance& radiance, Vec3 normal, const Sampling& sampling,
                  std::int64_t count, carlo::Rng& rng) {
  const Frame frame(normal);
  double sum = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto [wi, weight] = draw(sampling, frame, rng);
    if (weight > 0) sum += static_cast<double>(weight * radiance(wi));
  }
  return sum / static_cast<double>(count);
}

double ambient_occlusion(const Visible& visible, Vec3 normal, const Sampling& sampling,
                         std::int64_t count, carlo::Rng& rng) {
  const auto sky = [&](Vec3 wi) { return visible(wi) ? 1 / pi_f : 0.0f; };
  return irradiance(sky, normal, sampling, count, rng);
}

// Lab 7.8 -----------------------------------------------------------------------------------------

Vec3 direction_at(Point place) {
  const double phi = 2 * carlo::pi * place.x, theta = carlo::pi * place.y;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

Point place_of(Vec3 w) {
  const double x = w.x, y = w.y, z = w.z;
  const double around = std::atan2(x, -z) / (2 * carlo::pi);
  const double down = std::atan2(std::hypot(x, z), y) / carlo::pi;
  const double last = std::nextafter(1.0, 0.0);
  return {std::min(around < 0 ? around + 1 : around, last), std::min(down, last)};
}

namespace {

/// The heights w.y between which a row lies.
struct Heights {
  double top, bottom;
};

Heights heights_of(std::size_t row, std::size_t rows) {
  return {std::cos(carlo::pi * lab05::bin_edge(row, rows)),
          std::cos(carlo::pi * lab05::bin_edge(row + 1, rows))};
}

std::vector<double> powers(std::span<const double> luminances, std::size_t width,
                           std::size_t height) {
  std::vector<double> weights(luminances.begin(), luminances.end());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto [top, bottom] = heights_of(i / width, height);
    weights[i] *= top - bottom;
  }
  return weights;
}

/// The height w.y is linear in the table's y, row by row, with this slope.
float per_solid_angle(const lab05::Tabulated2d& table, Point p) {
  const auto [top, bottom] = heights_of(lab05::bin_of(p.y, table.rows()), table.rows());
  const double slope = (top - bottom) * static_cast<double>(table.rows());
  return static_cast<float>(table.pdf(p) / (2 * carlo::pi * slope));
}

}  // namespace

ImageLight::ImageLight(std::span<const double> luminances, std::size_t width, std::size_t height)
    : table_(powers(luminances, width, height), width, height) {}

ImageLight::Sample ImageLight::sample(glm::dvec2 u) const {
  const Point p = table_.sample(u.y, u.x);
  const std::size_t row = lab05::bin_of(p.y, table_.rows());
  const auto [top, bottom] = heights_of(row, table_.rows());
  const double within = p.y * static_cast<double>(table_.rows()) - static_cast<double>(row);
  const double cosine = std::clamp(top + within * (bottom - top), -1.0, 1.0);
  return {direction_at({p.x, std::acos(cosine) / carlo::pi}), per_solid_angle(table_, p)};
}

float ImageLight::pdf(Vec3 wi) const {
  return per_solid_angle(table_, place_of(wi));
}

}  // namespace lab07
