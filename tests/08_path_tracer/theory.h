#pragma once

#include "08_path_tracer/places.h"
#include "08_path_tracer/scenes.h"
#include "grader/judge/judge.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// Closed forms and integrals, in double, for lab 8's checks.

namespace lab08_tests {

using Double2 = glm::dvec2;
using Double3 = glm::dvec3;
constexpr double pi = std::numbers::pi;

/// Mean and mean square of one estimate, and the probability that it is not 0, if requested.
struct Moments {
  double mean = 0, square = 0, lit = 0;
  double sd() const { return std::sqrt(std::max(square - mean * mean, 0.0)); }
  carlo::grader::Theory theory() const { return {mean, sd()}; }
};

/// Midpoint rule over [0, 1)^2: visit(u, v, weight).
template <class F>
void over_square(int n, const F& visit) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      visit((i + 0.5) / n, (j + 0.5) / n, 1.0 / n / n);
  }
}

/// Midpoint rule over heights u in [0, 1) and one turn: visit(u, cos(phi), sin(phi), weight). The
/// turn's cosines are computed once, not for every height.
template <class F>
void over_turns(int n, const F& visit) {
  std::vector<Double2> turns;
  for (int j = 0; j < n; ++j) {
    const double phi = 2 * pi * (j + 0.5) / n;
    turns.emplace_back(std::cos(phi), std::sin(phi));
  }
  for (int i = 0; i < n; ++i) {
    for (const Double2 turn : turns)
      visit((i + 0.5) / n, turn.x, turn.y, 1.0 / n / n);
  }
}

/// The factor that an estimate by area omits or inverts, as a typical mistake.
enum class Slip {
  none,
  cos_surface,
  cos_light,
  distance,
  distance_once,
  area,
  area_divided,  ///< divided by the area instead of multiplied
  density,       ///< multiplied by the density per solid angle
  shadow,
  cosine_twice  ///< nothing omitted: one more cosine at the surface
};

/// f cos(theta) over the density per solid angle, for a BRDF of 1/2 pi and radiance 1.
inline double area_term(Slip slip, double cos_surface, double cos_light, double d, double area) {
  const double f = 0.5 / pi, density = d * d / (cos_light * area);
  switch (slip) {
    case Slip::cos_surface:
      return f / density;
    case Slip::cos_light:
      return f * cos_surface / (density * cos_light);
    case Slip::distance:
      return f * cos_surface * d * d / density;
    case Slip::distance_once:
      return f * cos_surface * d / density;
    case Slip::area:
      return f * cos_surface / (density * area);
    case Slip::area_divided:
      return f * cos_surface / (density * area * area);
    case Slip::density:
      return f * cos_surface * density;
    case Slip::cosine_twice:
      return f * cos_surface * cos_surface / density;
    case Slip::none:
    case Slip::shadow:
      break;
  }
  return f * cos_surface / density;
}

/// One estimate of the radiance that a floor of albedo 1/2 at the origin reflects from a light of
/// radiance 1, by a point of the light that is uniform by area. Points on the screened half (x > 0)
/// count as hidden.
inline Moments by_area(Light light, Slip slip = Slip::none) {
  Moments m;
  const auto add = [&](Double3 p, Double3 n, double area, double weight) {
    const double d = glm::length(p);
    const double cos_surface = p.z / d, cos_light = -glm::dot(n, p) / d;
    if (!(cos_surface > 0 && cos_light > 0)) return;
    if (light == Light::covered && p.x > 0 && slip != Slip::shadow) return;
    const double value = area_term(slip, cos_surface, cos_light, d, area);
    m.mean += value * weight;
    m.square += value * value * weight;
    m.lit += weight;
  };
  constexpr int cells = 600;
  if (light == Light::disk) {
    over_turns(cells, [&](double u, double cosine, double sine, double weight) {
      const double r = std::sqrt(u);
      add({r * cosine, r * sine, 1}, {0, 0, -1}, pi, weight);
    });
  } else if (light == Light::sphere) {
    const double angle = 50 * pi / 180;
    const Double3 centre(2 * std::sin(angle), 0, 2 * std::cos(angle));
    over_turns(cells, [&](double u, double cosine, double sine, double weight) {
      const double z = 1 - 2 * u, r = std::sqrt(1 - z * z);
      const Double3 n(r * cosine, r * sine, z);
      add(centre + n, n, 4 * pi, weight);
    });
  } else {
    over_square(cells, [&](double u, double v, double weight) {
      if (light == Light::wall) return add({1, v, u}, {-1, 0, 0}, 1, weight);
      add({u - 0.5, v - 0.5, 1}, {0, 0, -1}, 1, weight);
    });
  }
  return m;
}

/// The same for a ball of light that is above the horizon and casts no shadow.
inline Moments ball_by_area(const LitBall& light) {
  Moments m;
  const auto radius = static_cast<double>(light.ball.radius);
  const auto radiance = static_cast<double>(light.radiance);
  over_turns(600, [&](double u, double cosine, double sine, double weight) {
    const double z = 1 - 2 * u, r = std::sqrt(1 - z * z);
    const Double3 n(r * cosine, r * sine, z), p = Double3(light.ball.center) + radius * n;
    const double d = glm::length(p), cos_light = -glm::dot(n, p) / d;
    if (!(cos_light > 0)) return;
    const double area = 4 * pi * radius * radius;
    const double value = radiance * area_term(Slip::none, p.z / d, cos_light, d, area);
    m.mean += value * weight;
    m.square += value * value * weight;
    m.lit += weight;
  });
  return m;
}

/// World::choose()'s probabilities, for lights that are not meshes.
inline std::vector<double> light_chances(const std::vector<double>& powers) {
  double all = 0;
  for (const double power : powers)
    all += power;
  std::vector<double> chances;
  for (const double power : powers)
    chances.push_back((power / all + 1 / static_cast<double>(powers.size())) / 2);
  return chances;
}

/// The fraction of cosine-weighted directions that meets the light of mirrored_light(): its image
/// is as far behind the mirror as the light is in front.
inline double mirrored_share() {
  const double shift = 2 * static_cast<double>(mirror_distance);
  double share = 0;
  over_square(600, [&](double u, double v, double weight) {
    const Double3 p(shift + u - 0.5, v - 0.5, 1);
    const double d2 = glm::dot(p, p);
    share += weight / (pi * d2 * d2);
  });
  return share;
}

/// cos^n of the angle between two unit vectors, 0 for obtuse angles. The cosine comes from the
/// chord, so that pow() starts with an error of 1e-16 and ends, at n = 1e7, with one of 1e-9.
inline double cos_power(Double3 a, Double3 b, double n) {
  const double chord = glm::length(a - b);
  const double cosine = 1 - chord * chord / 2;
  return cosine > 0 ? std::pow(cosine, n) : 0;
}

/// The reflectance of places.h's grey materials in double.
struct PhongTheory {
  double kd, ks, n;

  explicit PhongTheory(const PhongCase& c)
      : kd(static_cast<double>(c.kd)), ks(static_cast<double>(c.ks)), n(static_cast<double>(c.n)) {}

  static Double3 mirrored(Double3 normal, Double3 wo) { return glm::reflect(-wo, normal); }
  double f(Double3 normal, Double3 wo, Double3 wi) const {
    if (!(glm::dot(normal, wi) > 0)) return 0;
    return kd / pi + ks * (n + 2) / (2 * pi) * cos_power(mirrored(normal, wo), wi, n);
  }
  double pdf(Double3 normal, Double3 wo, Double3 wi) const {
    const double cosine = glm::dot(normal, wi);
    if (!(cosine > 0)) return 0;
    return kd * cosine / pi + ks * (n + 1) / (2 * pi) * cos_power(mirrored(normal, wo), wi, n);
  }
  /// The weight of one sample, 0 if none is returned, at this angle of wo.
  Moments weights(double degrees) const {
    const double angle = degrees * pi / 180;
    const Double3 normal(0, 0, 1), wo(std::sin(angle), 0, std::cos(angle));
    Moments m;
    over_turns(1000, [&](double u, double cosine, double sine, double weight) {
      // wo has no y: the part at -y is the same.
      if (sine < 0) return;
      weight *= 2;
      const double r = std::sqrt(1 - u * u);
      const Double3 wi(r * cosine, r * sine, u);
      const double power = cos_power(mirrored(normal, wo), wi, n);
      const double value = (kd / pi + ks * (n + 2) / (2 * pi) * power) * u;
      const double density = kd * u / pi + ks * (n + 1) / (2 * pi) * power;
      if (!(density > 0)) return;
      m.mean += 2 * pi * weight * value;
      m.square += 2 * pi * weight * value * value / density;
    });
    return m;
  }
};

/// Directional albedo of the specular term for ks = 1 and whole n (J. Arvo's recurrences; all terms
/// are positive).
inline double specular_albedo(int n, double degrees) {
  const double theta = degrees * pi / 180, S = std::sin(theta), c = std::cos(theta);
  const auto w = [](int j) {
    double value = j % 2 == 0 ? pi / 2 : 1;
    for (int k = j % 2; k < j; k += 2)
      value *= (k + 1.0) / (k + 2);
    return value;
  };
  double sum = n % 2 == 0 ? c / 2 : c * (1 - theta / pi);
  for (int j = n % 2; j <= n; j += 2)
    sum += c * c / pi * std::pow(S, j) * w(j);
  return sum + std::pow(S, n + 2) * w(n) / pi;
}

/// Integrals over the part of a cone above a floor: solid angle, of cos and of cos^2.
struct ConeTheory {
  double whole = 0, above = 0, cosine = 0, square = 0;

  explicit ConeTheory(const SplitCase& c) {
    const auto one_minus_cos = static_cast<double>(c.one_minus_cos);
    const Double3 axis(c.axis);
    const Double3 across = glm::normalize(
        glm::cross(axis, std::abs(axis.z) < 0.9 ? Double3(0, 0, 1) : Double3(1, 0, 0)));
    const Double3 third = glm::cross(axis, across);
    whole = 2 * pi * one_minus_cos;
    over_turns(1000, [&](double u, double cosine_phi, double sine_phi, double weight) {
      const double h = u * one_minus_cos, r = std::sqrt(h * (2 - h));
      const double z = ((1 - h) * axis + r * cosine_phi * across + r * sine_phi * third).z;
      if (!(z > 0)) return;
      above += whole * weight;
      cosine += whole * weight * z;
      square += whole * weight * z * z;
    });
  }
};

}  // namespace lab08_tests
