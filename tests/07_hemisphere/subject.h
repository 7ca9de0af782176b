#pragma once

#include "07_hemisphere/law.h"

#include <string>
#include <utility>
#include <vector>

// The samplers of Labs 7.3 to 7.6 for their checks: the theory of each, and the results of typical
// mistakes.

namespace lab07_tests {

using carlo::grader::Diagnosis;
using carlo::grader::Params;
using carlo::grader::Rows;
using carlo::grader::Verdict;

/// A sampler with its parameters: its density is m/(2 pi) cos^(m-1) about the axis.
struct Subject {
  std::string name;
  Sampler sampler;
  double n = 0;  ///< exponent, if it has one
  Vec3 wo{0, 0, 1};

  double m() const {
    if (sampler == Sampler::uniform) return 1;
    return sampler == Sampler::cosine ? 2 : n + 1;
  }
  /// The law's axes, from the same floats that the student gets.
  Axes axes() const { return Axes(Double3(-wo.x, -wo.y, wo.z)); }
  double pdf(Double3 w) const { return power_law_pdf(m(), axes().local(w)); }

  /// The relative accuracy that a density from floats can have at w: n tan(alpha) times the
  /// rounding of a direction, and some operations.
  double tolerance(Double3 w) const {
    const Double3 local = axes().local(w);
    const double tangent = std::hypot(local.x, local.y) / std::abs(local.z);
    return 2e-5 + 1e-6 * (m() - 1) * tangent;
  }

  Params params(std::int64_t count = 0) const {
    return {.n = count,
            .numbers = {{"sampler", static_cast<double>(sampler)},
                        {"exponent", n},
                        {"x", wo.x},
                        {"y", wo.y},
                        {"z", wo.z}}};
  }
};

inline Subject uniform_subject() {
  return {"the uniform hemisphere", Sampler::uniform};
}
inline Subject cosine_subject() {
  return {"the cosine-weighted hemisphere", Sampler::cosine};
}
inline Subject lobe_subject(double n) {
  return {fmt::format("the lobe of n = {:g}", n), Sampler::lobe, n};
}
/// wo at `degrees` to the normal.
inline Subject mirror_subject(double n, double degrees) {
  return {fmt::format("the lobe of n = {:g} about the mirror direction, wo at {:g} degrees", n,
                      degrees),
          Sampler::mirror, n, at_angles(degrees * pi / 180, 0.9)};
}

/// The law of a typical mistake.
struct OtherLaw {
  Share share;
  Diagnosis diagnosis;
  double turn = 2 * pi;
};

/// Another density, by direction.
struct OtherPdf {
  std::function<double(Double3)> pdf;
  Diagnosis diagnosis;
};

inline const Diagnosis reused_number{"reused-number",
                                     "the angle and the azimuth come from one random number: the "
                                     "directions lie on a curve."};
inline const Diagnosis half_turn{"half-a-turn",
                                 "phi covers half a turn only: it runs from 0 to 2 pi."};
inline const Diagnosis below_kept{"below-horizon-kept", "there are directions below the horizon."};

inline const Diagnosis near_horizon{
    "no-density-near-horizon",
    "near the horizon x^2 + y^2 rounds to 1 or more, and 1 minus it to 0 or less, whose "
    "logarithm is undefined: there w.z determines the angle."};

/// Chi-square of directions; reports what wrong ones look like.
inline Verdict samples_follow(const Subject& subject, const std::vector<Double3>& world,
                              const std::vector<OtherLaw>& others = {}) {
  const std::vector<Double3> local = local_to(subject.axes(), world);
  const Share right = power_law(subject.m());
  Verdict verdict = distributed("directions of " + subject.name, local, right);
  if (verdict.passed) return verdict;
  if (number_reused(local, right)) verdict.diagnoses.push_back(reused_number);
  // Half a turn from wherever it starts is not a density of the other half.
  if (distributed("", local, right, pi).passed) verdict.diagnoses.push_back(half_turn);
  for (const OtherLaw& other : others) {
    if (distributed("", local, other.share, other.turn).passed) {
      verdict.diagnoses.push_back(other.diagnosis);
    }
  }
  return verdict;
}

/// Six digits, or "NaN ...".
inline std::string number_or_nan(double value) {
  return std::isnan(value) ? "NaN" : fmt::format("{:.6g}", value);
}

inline bool agree(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b) + 1e-30;
}

/// Densities by the angle to the lobe's axis.
inline carlo::grader::Figure density_figure(const Subject& subject,
                                            const std::vector<Double3>& places,
                                            const std::vector<double>& measured) {
  std::vector<double> angles, expected;
  for (const Double3 w : places) {
    angles.push_back(degrees(angle_to_axis(subject.axes().local(w))));
    expected.push_back(subject.pdf(w));
  }
  return carlo::grader::curve_figure(
      "angle to the axis, in degrees", angles, measured, expected, [&](std::size_t i) {
        return !agree(measured[i], expected[i], subject.tolerance(places[i]));
      });
}

/// Compares the student's density at each place with theory; reports a mistake that all values
/// agree with.
inline Verdict density_is(const std::string& what, const Subject& subject,
                          const std::vector<Double3>& places, const std::vector<double>& measured,
                          const std::vector<OtherPdf>& others = {}) {
  const auto fits = [&](const std::function<double(Double3)>& pdf) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!agree(measured[i], pdf(places[i]), 2 * subject.tolerance(places[i]))) return false;
    }
    return true;
  };
  const auto wrong_near_horizon_only = [&] {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double z = subject.axes().local(places[i]).z;
      const bool right = agree(measured[i], subject.pdf(places[i]), subject.tolerance(places[i]));
      if (!right && !(z > 0 && z < 0.2)) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double exact = subject.pdf(places[i]);
    const double tolerance = subject.tolerance(places[i]);
    if (agree(measured[i], exact, tolerance)) continue;
    const Double3 w = places[i];
    Verdict verdict = carlo::grader::equals(
        fmt::format("{} at w = ({:.6g}, {:.6g}, {:.6g})", what, w.x, w.y, w.z), measured[i], exact,
        tolerance * exact + 1e-30);
    verdict.figure = density_figure(subject, places, measured);
    for (const OtherPdf& other : others) {
      if (fits(other.pdf)) verdict.diagnoses.push_back(other.diagnosis);
    }
    const bool has_exponent =
        subject.sampler == Sampler::lobe || subject.sampler == Sampler::mirror;
    if (verdict.diagnoses.empty() && has_exponent && wrong_near_horizon_only()) {
      verdict.diagnoses.push_back(near_horizon);
    }
    return verdict;
  }
  return carlo::grader::holds(what, true, fmt::format("right at all {} places", places.size()),
                              "right everywhere");
}

inline const Diagnosis cosine_rounded{
    "cosine-has-rounded",
    "the n-th power of a float cosine: a step of 6e-8 in the cosine is a factor e^0.6 for n = "
    "1e7. Compute the angle from w.x and w.y."};

/// density_is() across a narrow lobe, where cosines round to 1.
inline Verdict narrow_density_is(const Subject& subject, const std::vector<Double3>& places,
                                 const std::vector<double>& measured) {
  Verdict verdict = density_is("the density of " + subject.name, subject, places, measured);
  bool near = true;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double ratio = measured[i] / subject.pdf(places[i]);
    near = near && ratio > 1e-4 && ratio < 20;
  }
  if (!verdict.passed && near && subject.n > 1e4) verdict.diagnoses.push_back(cosine_rounded);
  return verdict;
}

/// Judges the density all over the sphere: against theory, and its integral, which must be 1.
void judge_density(const Subject& subject, const std::vector<OtherPdf>& others,
                   const carlo::grader::Suspects& integrals);

/// For every pair of u at the edges: length 1, a finite density above 0, above the horizon if there
/// is one.
void judge_edges(const Subject& subject, const std::vector<Diagnosis>& at_zero);

/// Checks that nearby u give nearby directions, whatever the mapping; it may jump along a few
/// lines.
void judge_neighbours(const Subject& subject);

/// `count` directions from random numbers, with the student's densities.
struct Drawn {
  std::vector<Double3> directions;
  std::vector<double> pdf;
};
Drawn draw(const Subject& subject, std::size_t count);

/// Checks that directions have length 1, that none is below the horizon (except for the mirror's
/// lobe), and that the density of each is theory's. `all_below`: the diagnosis if none is above.
void judge_drawn(const Subject& subject, const Drawn& drawn,
                 const std::vector<Diagnosis>& all_below = {});

}  // namespace lab07_tests
