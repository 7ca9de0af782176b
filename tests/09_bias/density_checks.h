#pragma once

#include "09_bias/density_scenes.h"
#include "grader/judge/judge.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Helpers for the checks of Lab 9.5.

namespace lab09_density {

using DensityVec = glm::dvec3;
using carlo::grader::Diagnosis, carlo::grader::Rows, carlo::grader::Verdict;

/// The radiances that a typical mistake would give, one for each of those judged together.
struct Reading {
  Diagnosis diagnosis;
  std::vector<DensityVec> radiances;
};

inline std::vector<DensityVec> radiances(const Rows& rows) {
  std::vector<DensityVec> all;
  for (std::size_t i = 0; i < rows.count(); ++i)
    all.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  return all;
}

constexpr double radiance_tolerance = 1e-4;  ///< relative to the largest channel

inline bool same_radiance(DensityVec is, DensityVec should) {
  const double size = std::max({std::abs(should.r), std::abs(should.g), std::abs(should.b)});
  const DensityVec off = glm::abs(is - should);
  // NaN equals nothing.
  return off.r <= radiance_tolerance * size && off.g <= radiance_tolerance * size &&
         off.b <= radiance_tolerance * size;
}

inline bool same_radiances(const std::vector<DensityVec>& are,
                           const std::vector<DensityVec>& should) {
  return std::equal(are.begin(), are.end(), should.begin(), should.end(), same_radiance);
}

inline std::string radiance_text(DensityVec radiance) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", radiance.r, radiance.g, radiance.b);
}

/// Checks that every radiance is right; otherwise names a reading that fits all of them. `names`:
/// what each is.
inline void judge_radiances(const std::vector<DensityVec>& are,
                            const std::vector<DensityVec>& should,
                            const std::vector<std::string>& names,
                            const std::vector<Reading>& readings) {
  std::vector<Diagnosis> found, looked_for;
  const bool right = same_radiances(are, should);
  for (const Reading& reading : readings) {
    looked_for.push_back(reading.diagnosis);
    if (!right && same_radiances(are, reading.radiances)) found.push_back(reading.diagnosis);
  }
  for (std::size_t i = 0; i < are.size(); ++i) {
    const bool same = same_radiance(are[i], should[i]);
    Verdict verdict =
        carlo::grader::holds(names[i], same, radiance_text(are[i]), radiance_text(should[i]),
                             same ? std::vector<Diagnosis>{} : found);
    if (!same) verdict.looked_for = looked_for;
    carlo::grader::judge(verdict);
  }
}

inline double cosine_of(const DensityPhoton& photon, DensityVec normal) {
  return glm::dot(DensityVec(photon.wi), normal);
}

/// radiance_within() for a BRDF that is the same function for all.
inline DensityVec density_within(const std::vector<DensityPhoton>& photons, DensityVec at,
                                 DensityVec normal, double radius) {
  DensityVec sum(0);
  for (const DensityPhoton& photon : photons) {
    if (glm::length(DensityVec(photon.p) - at) < radius && cosine_of(photon, normal) > 0)
      sum += DensityVec(density_brdf(photon.wi)) * DensityVec(photon.flux);
  }
  return sum / (std::numbers::pi * radius * radius);
}

}  // namespace lab09_density
