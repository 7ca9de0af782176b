// Checks of the values of exercise 8.3: closed forms at 112 pairs of directions per material.

#include "08_path_tracer/theory.h"
#include "grader/judge/figures.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis diffuse_missing_pi{"one-over-pi-missing", "the diffuse term is kd/pi."};
const Diagnosis n_plus_one{"n-plus-one-in-f", "n + 1 normalises the density, n + 2 the BRDF."};
const Diagnosis n_plus_two{"n-plus-two-in-pdf", "n + 2 normalises the BRDF, n + 1 the density."};
const Diagnosis with_cosine{"cosine-in-f", "the cosine is not part of the BRDF."};
const Diagnosis back_of_lobe{"back-of-the-lobe",
                             "beyond 90 degrees from the mirror direction cos(alpha) is negative: "
                             "it counts as 0 there, and its power too."};
const Diagnosis below_horizon{"below-the-horizon", "below the horizon f and pdf are 0."};
const Diagnosis power_of_rounding{"power-of-a-rounded-cosine",
                                  "a dot product of unit vectors may round to 1.0000001, which a "
                                  "large n amplifies: use |a - b|^2/2 = 1 - cos."};
const Diagnosis one_minus_rounded{
    "one-minus-small-rounded",
    "|a - b|^2/2 = 1 - cos is right, but subtracted from 1 it is rounded to multiples of 6e-8, "
    "which a large n amplifies: exp(n log1p(-|a - b|^2/2)) keeps all its digits."};
const Diagnosis about_normal{"lobe-about-the-normal",
                             "the lobe is centred on the normal: alpha is the angle with the "
                             "mirror direction of wo."};
const Diagnosis about_wo{"lobe-about-wo",
                         "the lobe is centred on wo itself: alpha is the angle with the mirror "
                         "direction of wo."};
const Diagnosis half_vector{
    "half-vector",
    "alpha is the angle of wi with the mirror direction of wo. The angle between the normal and "
    "the half vector of wo and wi is about half of it, as in Blinn's BRDF."};
const Diagnosis always_normalised{"chances-always-normalised",
                                  "probabilities are divided by their sum only if it is above 1: "
                                  "the rest to 1 is the probability of absorption."};
const Diagnosis mean_of_channels{"mean-of-channels",
                                 "a lobe's probability is the largest channel, not their mean."};
const Diagnosis one_lobe_pdf{"density-of-one-lobe",
                             "a direction may have come from either lobe: its density is the sum "
                             "of both, each times the lobe's probability."};
const Diagnosis no_chances{"chances-not-in-pdf",
                           "each lobe's density has to be multiplied by the lobe's probability."};
const Diagnosis not_scaled{"chances-above-one",
                           "probabilities that add up to more than 1 have to be divided by their "
                           "sum."};

using ValueOf = std::function<double(const DirectionPair&)>;

struct Alternative {
  ValueOf value;
  Diagnosis diagnosis;
};

double lobe_cosine(const DirectionPair& d) {
  return glm::dot(PhongTheory::mirrored(Double3(d.normal), Double3(d.wo)), Double3(d.wi));
}

bool like(const std::vector<double>& measured, const std::vector<DirectionPair>& pairs,
          const ValueOf& value, double tolerance) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double v = value(pairs[i]);
    if (std::abs(lobe_cosine(pairs[i])) < 1e-5) continue;
    if (!(std::abs(measured[i] - v) <= tolerance * std::abs(v) + 1e-6)) return false;
  }
  return true;
}

double cosine_of(const DirectionPair& d) {
  return glm::dot(Double3(d.normal), Double3(d.wi));
}

/// Values that are `diffuse` plus `peak` times cos^n.
struct Lobe {
  double peak, n;
  ValueOf diffuse;
};

/// The effect of rounding on the lobe's cosine: everything is right except for pairs of nearly
/// equal vectors, and these are as if the cosine were off by a few roundings of a float below 1.
std::vector<Diagnosis> of_rounding(const Lobe& lobe, const std::vector<double>& measured,
                                   const std::vector<DirectionPair>& pairs, const ValueOf& exact,
                                   double tolerance) {
  double worst = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double right = exact(pairs[i]), diffuse = lobe.diffuse(pairs[i]);
    if (right - diffuse < 1e-3 * lobe.peak) {
      if (!(std::abs(measured[i] - right) <= tolerance * right + 1e-6)) return {};
      continue;
    }
    const auto cosine = [&](double v) { return std::pow((v - diffuse) / lobe.peak, 1 / lobe.n); };
    const double off = std::abs(cosine(measured[i]) - cosine(right)) * 0x1p24;
    if (!(off <= 16)) return {};
    worst = std::max(worst, off);
  }
  return {worst < 0.6 ? one_minus_rounded : power_of_rounding};
}

/// The pairs that differ.
Figure values_picture(const std::vector<DirectionPair>& pairs, const std::vector<double>& measured,
                      const ValueOf& exact, double tolerance) {
  std::vector<double> expected;
  expected.reserve(pairs.size());
  for (const DirectionPair& pair : pairs)
    expected.push_back(exact(pair));
  const auto degrees = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / pi;
  };
  return differences_listing(
      "wi to normal, to mirror (degrees)",
      [&](std::size_t i) {
        return fmt::format("{:.3g}, {:.3g}", degrees(cosine_of(pairs[i])),
                           degrees(lobe_cosine(pairs[i])));
      },
      measured, expected,
      [&](std::size_t i) {
        if (std::abs(cosine_of(pairs[i])) < 1e-5 || std::abs(lobe_cosine(pairs[i])) < 1e-5) {
          return false;
        }
        return !(std::abs(measured[i] - expected[i]) <= tolerance * expected[i] + 1e-6);
      });
}

/// True if the half vector explains the values. With the largest n they are rounded beyond
/// recognition; but then a smaller n shows the mistake.
bool by_half_vector(const PhongTheory& t, const std::vector<double>& measured,
                    const std::vector<DirectionPair>& pairs, const ValueOf& diffuse, double scale) {
  if (t.n < 1 || t.n > 100) return false;
  return like(
      measured, pairs,
      [&](const DirectionPair& d) {
        if (!(cosine_of(d) > 0)) return 0.0;
        const Double3 half = glm::normalize(Double3(d.wo) + Double3(d.wi));
        return diffuse(d) + scale * cos_power(Double3(d.normal), half, t.n);
      },
      1e-4);
}

void judge_values(const std::string& what, const PhongCase& c, const std::vector<double>& measured,
                  const ValueOf& exact, const std::vector<Alternative>& alternatives,
                  const Lobe& lobe, bool& half) {
  const std::vector<DirectionPair> pairs = direction_pairs(c.n);
  // 1 - cos has a relative error of some float roundings over its angle, and n times as much in the
  // power.
  const double tolerance = 1e-5 + 2e-6 * std::sqrt(static_cast<double>(c.n));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    // On the very edge of the hemisphere or of the lobe rounding decides.
    if (std::abs(cosine_of(pairs[i])) < 1e-5 || std::abs(lobe_cosine(pairs[i])) < 1e-5) continue;
    const double expected = exact(pairs[i]);
    if (std::abs(measured[i] - expected) <= tolerance * expected + 1e-6) continue;
    Verdict verdict =
        equals(fmt::format("{}, {}, wi {:.3g} degrees from the normal", what, name_of(c),
                           std::acos(std::clamp(cosine_of(pairs[i]), -1.0, 1.0)) * 180 / pi),
               measured[i], expected, tolerance * expected + 1e-6);
    verdict.figure = values_picture(pairs, measured, exact, tolerance);
    half = half || by_half_vector(PhongTheory(c), measured, pairs, lobe.diffuse, lobe.peak);
    if (!(cosine_of(pairs[i]) > 0)) {
      verdict.diagnoses.push_back(below_horizon);
    } else if (half) {
      verdict.diagnoses.push_back(half_vector);
    } else {
      for (const Alternative& other : alternatives) {
        if (like(measured, pairs, other.value, tolerance))
          verdict.diagnoses.push_back(other.diagnosis);
      }
      const auto right_in_front = [&] {
        for (std::size_t j = 0; j < pairs.size(); ++j) {
          const double v = exact(pairs[j]);
          if (lobe_cosine(pairs[j]) > 1e-5 && cosine_of(pairs[j]) > 0 &&
              !(std::abs(measured[j] - v) <= tolerance * v + 1e-6))
            return false;
        }
        return true;
      };
      if (verdict.diagnoses.empty() && c.n > 0 && right_in_front())
        verdict.diagnoses.push_back(back_of_lobe);
      if (verdict.diagnoses.empty() && c.n >= 1e6f) {
        verdict.diagnoses = of_rounding(lobe, measured, pairs, exact, tolerance);
      }
    }
    judge(verdict);
    return;
  }
  judge(holds(what + ", " + name_of(c), true, fmt::format("right for all {} pairs", pairs.size()),
              "right"));
}

Rows values_of(std::size_t i) {
  return probe("Lab 8.3 values", {.numbers = {{"case", static_cast<double>(i)}}},
               {.rows = direction_pairs(phong_cases()[i].n).size(),
                .columns = 2,
                .finite = false,
                .of = name_of(phong_cases()[i])});
}

/// f and pdf with the lobe about another direction.
double f_about(const PhongTheory& t, const DirectionPair& d, Vec3 axis) {
  if (!(cosine_of(d) > 0)) return 0;
  return t.kd / pi + t.ks * (t.n + 2) / (2 * pi) * cos_power(Double3(axis), Double3(d.wi), t.n);
}

double pdf_about(const PhongTheory& t, const DirectionPair& d, Vec3 axis) {
  if (!(cosine_of(d) > 0)) return 0;
  return t.kd * cosine_of(d) / pi +
         t.ks * (t.n + 1) / (2 * pi) * cos_power(Double3(axis), Double3(d.wi), t.n);
}

/// No pair of directions lies in a very narrow lobe elsewhere: any pair would fit it.
bool tells_axes_apart(const PhongCase& c) {
  return c.ks > 0 && c.n > 0 && c.n < 100;
}

}  // namespace

TEST_CASE("Lab 8.3: the BRDF's values, to n = 1e7 and at grazing angles", "[lab08][ex3]") {
  bool half = false;
  for (std::size_t i = 0; i < phong_cases().size(); ++i) {
    const PhongCase c = phong_cases()[i];
    const PhongTheory theory(c);
    PhongTheory no_pi = theory;
    no_pi.kd *= pi;
    const auto f = [&](const DirectionPair& d) {
      return theory.f(Double3(d.normal), Double3(d.wo), Double3(d.wi));
    };
    std::vector<Alternative> alternatives{
        {[&](const DirectionPair& d) { return f(d) * std::max(cosine_of(d), 0.0); }, with_cosine}};
    if (c.kd > 0) {
      alternatives.push_back({[&](const DirectionPair& d) {
                                return no_pi.f(Double3(d.normal), Double3(d.wo), Double3(d.wi));
                              },
                              diffuse_missing_pi});
    }
    if (tells_axes_apart(c)) {
      alternatives.push_back(
          {[&](const DirectionPair& d) { return f_about(theory, d, d.normal); }, about_normal});
      alternatives.push_back(
          {[&](const DirectionPair& d) { return f_about(theory, d, d.wo); }, about_wo});
    }
    if (c.ks > 0 && c.n < 100) {
      alternatives.push_back({[&](const DirectionPair& d) {
                                PhongTheory less = theory;
                                less.ks *= (theory.n + 1) / (theory.n + 2);
                                return less.f(Double3(d.normal), Double3(d.wo), Double3(d.wi));
                              },
                              n_plus_one});
    }
    judge_values("f", c, column(values_of(i), 0), f, alternatives,
                 {theory.ks * (theory.n + 2) / (2 * pi), theory.n,
                  [&](const DirectionPair& d) { return cosine_of(d) > 0 ? theory.kd / pi : 0; }},
                 half);
  }
}

TEST_CASE("Lab 8.3: the density of both lobes together", "[lab08][ex3]") {
  bool half = false;
  for (std::size_t i = 0; i < phong_cases().size(); ++i) {
    const PhongCase c = phong_cases()[i];
    const PhongTheory theory(c);
    const auto with = [](PhongTheory t, double diffuse, double specular) {
      t.kd *= diffuse;
      t.ks *= specular;
      return [t](const DirectionPair& d) {
        return t.pdf(Double3(d.normal), Double3(d.wo), Double3(d.wi));
      };
    };
    std::vector<Alternative> alternatives;
    if (c.ks > 0 && c.n < 100) {
      alternatives.push_back({with(theory, 1, (theory.n + 2) / (theory.n + 1)), n_plus_two});
    }
    if (c.kd > 0 && c.ks > 0) {
      alternatives.push_back({with(theory, 1, 0), one_lobe_pdf});
      alternatives.push_back({with(theory, 0, 1), one_lobe_pdf});
      alternatives.push_back({with(theory, 1 / theory.kd, 1 / theory.ks), no_chances});
    }
    const double sum = theory.kd + theory.ks;
    alternatives.push_back({with(theory, 1 / sum, 1 / sum), always_normalised});
    if (tells_axes_apart(c)) {
      alternatives.push_back(
          {[&](const DirectionPair& d) { return pdf_about(theory, d, d.normal); }, about_normal});
      alternatives.push_back(
          {[&](const DirectionPair& d) { return pdf_about(theory, d, d.wo); }, about_wo});
    }
    judge_values("pdf", c, column(values_of(i), 1), with(theory, 1, 1), alternatives,
                 {theory.ks * (theory.n + 1) / (2 * pi), theory.n, with(theory, 1, 0)}, half);
  }
}

TEST_CASE("Lab 8.3: the lobes' chances", "[lab08][ex3]") {
  const Rows rows =
      probe("Lab 8.3 chances", {}, {.rows = chance_cases().size(), .columns = 2, .finite = false});
  std::vector<double> expected;
  bool unscaled = true, normalised = true, averaged = true;
  for (std::size_t i = 0; i < chance_cases().size(); ++i) {
    const auto [kd, ks] = chance_cases()[i];
    const double d = static_cast<double>(std::max({kd.r, kd.g, kd.b}));
    const double s = static_cast<double>(std::max({ks.r, ks.g, ks.b}));
    const double sum = std::max(1.0, d + s);
    expected.insert(expected.end(), {d / sum, s / sum});
    const auto are = [&](double diffuse, double specular) {
      return std::abs(rows.at(i, 0) - diffuse) <= 1e-6 &&
             std::abs(rows.at(i, 1) - specular) <= 1e-6;
    };
    const auto mean = [](Rgb c) { return static_cast<double>(c.r + c.g + c.b) / 3; };
    unscaled = unscaled && are(d, s);
    normalised = normalised && (d + s == 0 || are(d / (d + s), s / (d + s)));
    averaged = averaged && are(mean(kd), mean(ks));
  }
  std::vector<Diagnosis> diagnoses;
  if (unscaled) diagnoses.push_back(not_scaled);
  if (normalised) diagnoses.push_back(always_normalised);
  if (averaged) diagnoses.push_back(mean_of_channels);
  judge(all_equal("chances of the diffuse and the specular lobe", rows.values, expected, 1e-6,
                  diagnoses));
}
