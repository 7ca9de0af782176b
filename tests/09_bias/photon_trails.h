#pragma once

#include "09_bias/photon_checks.h"

#include <functional>
#include <string>
#include <vector>

// Stored photons, and the right ones.

namespace lab09_photons {

inline const Diagnosis counts_itself{"counts-the-surface-itself",
                                     "phong and specular count the surfaces that the photon met "
                                     "before, not the one where it is stored."};
inline const Diagnosis phong_not_counted{"phong-not-counted",
                                         "phong does not grow at Phong surfaces."};

constexpr std::size_t shown_photons = 3;  ///< photons shown by the probe for each one sent

/// A stored photon; for an expected one, also the tolerance of wi.
struct Stored {
  PhotonVec p, wi, flux;
  double phong, specular;
  double wi_tolerance = 1e-3;
};

/// The photons stored for one that was sent.
struct Trail {
  std::vector<Stored> stored;  ///< the first `shown_photons`
  double count = 0;
};

inline std::vector<Trail> trails(PhotonPlace place, const std::string& name, std::size_t photons) {
  const Rows rows = carlo::grader::probe(
      "Lab 9.4 stored",
      {.n = static_cast<std::int64_t>(photons), .numbers = {{"place", static_cast<double>(place)}}},
      {.rows = shown_photons * photons, .columns = 12, .of = name});
  std::vector<Trail> all(photons);
  for (std::size_t i = 0; i < photons; ++i) {
    Trail& trail = all[i];
    trail.count = rows.at(shown_photons * i, 11);
    for (std::size_t k = 0; k < shown_photons && static_cast<double>(k) < trail.count; ++k) {
      const std::size_t row = shown_photons * i + k;
      trail.stored.push_back({vec(rows, row, 0), vec(rows, row, 3), vec(rows, row, 6),
                              rows.at(row, 9), rows.at(row, 10)});
    }
  }
  return all;
}

/// The right photon number k of a trail.
using Expected = std::function<Stored(std::size_t trail, std::size_t k)>;

/// The number of photons that are wrong, in each respect.
struct Differences {
  double p = 0, wi = 0, flux = 0, phong = 0, specular = 0, all = 0;

  Differences(const std::vector<Trail>& trails, const Expected& expected) {
    for (std::size_t i = 0; i < trails.size(); ++i) {
      for (std::size_t k = 0; k < trails[i].stored.size(); ++k) {
        const Stored &is = trails[i].stored[k], should = expected(i, k);
        all += 1;
        p += glm::length(is.p - should.p) <= 1e-3 ? 0 : 1;
        wi += glm::length(is.wi - should.wi) <= should.wi_tolerance ? 0 : 1;
        flux += off(is.flux, should.flux) <= 1e-4 ? 0 : 1;
        phong += is.phong == should.phong ? 0 : 1;
        specular += is.specular == should.specular ? 0 : 1;
      }
    }
  }
};

/// True if `has` holds for all photons for which `which` does, and there are some.
inline bool photons_have(const std::vector<Trail>& trails,
                         const std::function<bool(const Stored&, std::size_t k)>& which,
                         const std::function<bool(const Stored&, std::size_t k)>& has) {
  double some = 0, right = 0;
  for (const Trail& trail : trails) {
    for (std::size_t k = 0; k < trail.stored.size(); ++k) {
      if (!which(trail.stored[k], k)) continue;
      some += 1;
      right += has(trail.stored[k], k) ? 1 : 0;
    }
  }
  return some > 0 && right == some;
}

inline void judge_none(const std::string& what, double count, double of,
                       const std::vector<Diagnosis>& diagnoses) {
  carlo::grader::judge(carlo::grader::holds(
      what, count == 0, fmt::format("{:g} of {:g}", count, of), "0", diagnoses));
}

inline const PhotonVec sent(sent_flux);

inline bool any_photon(const Stored&, std::size_t) {
  return true;
}
inline auto photon_number_is(std::size_t number) {
  return [number](const Stored&, std::size_t k) { return k == number; };
}
inline auto photon_flux_is(PhotonVec flux) {
  return [flux](const Stored& s, std::size_t) { return off(s.flux, flux) <= 1e-4; };
}

inline std::vector<Diagnosis> of_counts(const std::vector<Trail>& all) {
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t k) {
        return s.phong == static_cast<double>(k + 1);
      }))
    return {counts_itself};
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t) { return s.phong == 0; }))
    return {phong_not_counted};
  return {};
}

}  // namespace lab09_photons
