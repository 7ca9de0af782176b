#pragma once

#include "07_hemisphere/law.h"
#include "07_hemisphere/lights.h"
#include "07_hemisphere/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

// Theory for estimates of irradiance: mean, spread and kurtosis for a light and a technique, by
// quadrature.

namespace lab07_tests {

enum class Technique { rejection = 0, uniform = 1, cosine = 2, lobe = 3 };

/// The integrand, and the technique.
struct Case {
  std::string name;
  Light light;
  Technique technique;
  double n = 1;        ///< for the lobe,
  bool aimed = false;  ///< which points at the light, or otherwise along the normal
};

inline constexpr std::array<const char*, 4> technique_names = {
    "rejection", "uniform directions", "cosine-weighted directions", "the lobe"};
inline constexpr std::array<const char*, 6> light_names = {
    "an open sky", "a ball", "a ball half set", "a disk", "a wall", "a tiny sun"};

inline Case make(Light light, Technique technique, double n = 1, bool aimed = false) {
  return {fmt::format("{}, by {}{}", light_names[static_cast<std::size_t>(light)],
                      technique_names[static_cast<std::size_t>(technique)],
                      technique == Technique::lobe ? fmt::format(" of n = {:g}", n) : ""),
          light, technique, n, aimed};
}

inline Double3 axis_of(const Case& c) {
  return c.aimed ? light_centre(c.light) : Double3(0, 0, 1);
}

inline double pdf_of(const Case& c, Double3 w) {
  switch (c.technique) {
    case Technique::rejection:
    case Technique::uniform:
      return power_law_pdf(1, w);
    case Technique::cosine:
      return power_law_pdf(2, w);
    case Technique::lobe:
      break;
  }
  return power_law_pdf(c.n + 1, Axes(axis_of(c)).local(w));
}

/// Calls f with the directions above the horizon from which light comes, and with their solid
/// angles; with below = true, those below it.
template <class F>
void over_lit(const Case& c, const F& f, bool below = false) {
  const auto where_lit = [&](Double3 w, double solid_angle) {
    if ((w.z > 0) != below && lit(c.light, w)) f(w, solid_angle);
  };
  const double cone = c.light == Light::sun ? sun_angle : pi / 6;
  if (c.light == Light::ball || c.light == Light::sunset || c.light == Light::sun) {
    const double half = std::sin(cone / 2);
    over_directions(light_centre(c.light), 2 * half * half, where_lit);
  } else if (!below) {
    over_directions({0, 0, 1}, 1, where_lit);
  }
}

template <class F>
double lit_integral(const Case& c, const F& f, bool below = false) {
  double sum = 0;
  over_lit(
      c, [&](Double3 w, double solid_angle) { sum += f(w) * solid_angle; }, below);
  return sum;
}

/// Statistics of one direction's contribution L cos/p.
struct Contribution {
  double mean, sd, excess_kurtosis;
};

inline Contribution integrated(const Case& c) {
  const double mean = exact_irradiance(c.light);
  double m2 = 0, m3 = 0, m4 = 0;
  over_lit(c, [&](Double3 w, double solid_angle) {
    const double y = w.z / pdf_of(c, w), square = w.z * y * solid_angle;
    m2 += square;
    m3 += square * y;
    m4 += square * y * y;
  });
  const double variance = std::max(m2 - mean * mean, 0.0);
  const double fourth = m4 - 4 * mean * m3 + 6 * mean * mean * m2 - 3 * std::pow(mean, 4);
  return {mean, std::sqrt(variance), variance > 0 ? fourth / (variance * variance) - 3 : 0};
}

/// A case is judged for several normals and in several tests, but integrated only once.
inline const Contribution& contribution(const Case& c) {
  using Key = std::tuple<Light, Technique, double, bool>;
  static std::map<Key, Contribution> known;
  const Key key{c.light, c.technique, c.n, c.aimed};
  auto found = known.find(key);
  if (found == known.end()) found = known.emplace(key, integrated(c)).first;
  return found->second;
}

/// Directions per estimate, and the number of estimates requested.
inline constexpr double count = 16, repetitions = 20'000;

inline carlo::grader::Theory theory_of(const Case& c, double scale = 1) {
  const Contribution one = contribution(c);
  return {scale * one.mean, scale * one.sd / std::sqrt(count), one.excess_kurtosis / count};
}

/// The part of an aimed lobe that lies below the horizon.
inline double lost_part(const Case& c) {
  if (c.technique != Technique::lobe) return 0;
  const Axes axes(axis_of(c));
  constexpr int steps = 400;
  double below = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = std::pow(1 - (i + 0.5) / steps, 1 / (c.n + 1));
    const double sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < steps; ++k) {
      const double phi = 2 * pi * (k + 0.5) / steps;
      if (axes.world({sine * std::cos(phi), sine * std::sin(phi), cosine}).z < 0) below += 1;
    }
  }
  return below / (steps * static_cast<double>(steps));
}

/// The irradiance under an open sky, within the reach of the technique's directions.
inline double open_sky(const Case& c) {
  const Axes axes(axis_of(c));
  double sum = 0;
  over_directions({0, 0, 1}, 1, [&](Double3 w, double solid_angle) {
    if (w.z > 0 && axes.local(w).z > 0) sum += w.z * solid_angle;
  });
  return sum;
}

}  // namespace lab07_tests
