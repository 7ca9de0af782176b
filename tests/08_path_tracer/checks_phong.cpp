// Checks of exercise 8.3. Values and densities: closed forms at 112 pairs of directions a material.
// Samples: 100 000 a case; chi-square over 64 cells against the density's integrals (cells off by 6
// % each, rms, are caught with power .999), the mean weight against the reflectance in closed form.

#include "08_path_tracer/theory.h"
#include "grader/judge/figures.h"
#include "stats/distributions.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis missing_pi{"one-over-pi-missing", "the diffuse term is kd/pi."};
const Diagnosis n_plus_one{"n-plus-one-in-f", "n + 1 normalises the density, n + 2 the BRDF."};
const Diagnosis n_plus_two{"n-plus-two-in-pdf", "n + 2 normalises the BRDF, n + 1 the density."};
const Diagnosis with_cosine{"cosine-in-f", "the cosine is not part of the BRDF."};
const Diagnosis back_of_lobe{"back-of-the-lobe",
                             "beyond 90 degrees from the mirror direction cos(alpha) is negative: "
                             "it counts as 0 there, and its power too."};
const Diagnosis below_horizon{"below-the-horizon", "below the horizon f and pdf are 0."};
const Diagnosis power_of_rounding{"power-of-a-rounded-cosine",
                                  "a dot product of unit vectors may round to 1.0000001, and a "
                                  "large n makes much of it: use |a - b|^2/2 = 1 - cos."};
const Diagnosis one_lobe_pdf{"density-of-one-lobe",
                             "a direction may have come from either lobe: its density is the sum, "
                             "each times the lobe's chance."};
const Diagnosis no_chances{"chances-not-in-pdf",
                           "each lobe's density has to be multiplied by the lobe's chance."};
const Diagnosis weight_without_pdf{
    "weight-without-pdf", "the weight is f cos(theta): it has to be divided by the density."};
const Diagnosis weight_without_cosine{"weight-without-cosine", "the weight lacks the cosine."};
const Diagnosis kept_below{"below-horizon-kept",
                           "directions below the horizon are returned: they carry nothing, and "
                           "they must not be drawn again."};
const Diagnosis reused{"random-number-reused",
                       "u_lobe decided on the lobe, and made the direction too: large parts of the "
                       "hemisphere are never reached."};
const Diagnosis never_absorbs{"never-absorbs",
                              "a direction is always returned: the rest of the chances is "
                              "absorption."};
const Diagnosis not_scaled{"chances-above-one",
                           "chances that add up to more than 1 are divided by their sum."};

std::string name_of(const PhongCase& c) {
  return fmt::format("kd = {:g}, ks = {:g}, n = {:g}", c.kd, c.ks, c.n);
}

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

void judge_values(const std::string& what, const PhongCase& c, const std::vector<double>& measured,
                  const ValueOf& exact, const std::vector<Alternative>& alternatives) {
  const std::vector<DirectionPair> pairs = direction_pairs(c.n);
  // 1 - cos has a relative error of some float roundings over its angle, n times as much in the
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
    if (!(cosine_of(pairs[i]) > 0)) {
      verdict.diagnoses.push_back(below_horizon);
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
      if (verdict.diagnoses.empty() && right_in_front()) verdict.diagnoses.push_back(back_of_lobe);
      if (verdict.diagnoses.empty() && c.n >= 1e6f) verdict.diagnoses.push_back(power_of_rounding);
    }
    judge(verdict);
    return;
  }
  judge(holds(what + ", " + name_of(c), true, fmt::format("right for all {} pairs", pairs.size()),
              "right"));
}

Rows values_of(std::size_t i) {
  return probe("Lab 8.3 values", {.numbers = {{"case", static_cast<double>(i)}}},
               {.rows = direction_pairs(phong_cases()[i].n).size(), .columns = 2, .finite = false});
}

}  // namespace

TEST_CASE("Lab 8.3: the BRDF's values, to n = 1e7 and at grazing angles", "[lab08][ex3]") {
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
                              missing_pi});
    }
    if (c.ks > 0 && c.n < 100) {
      alternatives.push_back({[&](const DirectionPair& d) {
                                PhongTheory less = theory;
                                less.ks *= (theory.n + 1) / (theory.n + 2);
                                return less.f(Double3(d.normal), Double3(d.wo), Double3(d.wi));
                              },
                              n_plus_one});
    }
    judge_values("f", c, column(values_of(i), 0), f, alternatives);
  }
}

TEST_CASE("Lab 8.3: the density of both lobes together", "[lab08][ex3]") {
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
    judge_values("pdf", c, column(values_of(i), 1), with(theory, 1, 1), alternatives);
  }
}

TEST_CASE("Lab 8.3: the lobes' chances", "[lab08][ex3]") {
  const Rows rows = probe("Lab 8.3 chances", {}, {.rows = chance_cases().size(), .columns = 2});
  std::vector<double> expected;
  bool unscaled = true;
  for (std::size_t i = 0; i < chance_cases().size(); ++i) {
    const auto [kd, ks] = chance_cases()[i];
    const double d = static_cast<double>(std::max({kd.r, kd.g, kd.b}));
    const double s = static_cast<double>(std::max({ks.r, ks.g, ks.b}));
    const double sum = std::max(1.0, d + s);
    expected.insert(expected.end(), {d / sum, s / sum});
    unscaled =
        unscaled && std::abs(rows.at(i, 0) - d) <= 1e-6 && std::abs(rows.at(i, 1) - s) <= 1e-6;
  }
  judge(all_equal("chances of the diffuse and the specular lobe", rows.values, expected, 1e-6,
                  unscaled ? std::vector{not_scaled} : std::vector<Diagnosis>{}));
}

namespace {

constexpr std::size_t draws = 100'000;

struct SampleCase {
  std::size_t material;  ///< of phong_cases()
  double degrees;
};

Rows samples_of(const SampleCase& c) {
  return probe(
      "Lab 8.3 samples",
      {.n = draws, .numbers = {{"case", static_cast<double>(c.material)}, {"degrees", c.degrees}}},
      {.rows = draws, .columns = 6});
}

std::string title(const SampleCase& c) {
  return fmt::format("{}, wo at {:g} degrees", name_of(phong_cases()[c.material]), c.degrees);
}

Double3 world_wo(double degrees) {
  return Double3(tilted_frame().at(direction_at(static_cast<float>(degrees), 0)));
}

/// The sample's direction along the frame's axes.
Double3 local(const Rows& rows, std::size_t i) {
  const Frame3 frame = tilted_frame();
  const Double3 wi(rows.at(i, 1), rows.at(i, 2), rows.at(i, 3));
  return {glm::dot(wi, Double3(frame.s)), glm::dot(wi, Double3(frame.t)),
          glm::dot(wi, Double3(frame.n))};
}

constexpr int rings = 8, sectors = 8;

std::vector<double> cell_masses(const SampleCase& c) {
  const PhongTheory theory(phong_cases()[c.material]);
  const double angle = c.degrees * pi / 180;
  const Double3 normal(0, 0, 1), wo(std::sin(angle), 0, std::cos(angle));
  std::vector<double> mass(rings * sectors + 1);
  over_square(800, [&](double u, double v, double weight) {
    const double r = std::sqrt(1 - u * u), phi = 2 * pi * v;
    const auto cell = static_cast<std::size_t>(static_cast<int>(u * rings) * sectors +
                                               static_cast<int>(v * sectors));
    mass[cell] +=
        2 * pi * weight * theory.pdf(normal, wo, {r * std::cos(phi), r * std::sin(phi), u});
  });
  mass.back() = 1;
  for (std::size_t i = 0; i + 1 < mass.size(); ++i)
    mass.back() -= mass[i];
  return mass;
}

/// Without the last cell, which counts what was absorbed.
Figure cells_picture(std::vector<double> counts, std::vector<double> mass) {
  const auto absorbed = counts.back();
  const double right = mass.back() * draws;
  counts.pop_back();
  mass.pop_back();
  for (double& m : mass)
    m *= draws;
  Figure figure = cells_figure("azimuth, 0 to 360 degrees", "cosine to the normal, from 0", sectors,
                               counts, mass);
  figure.note += fmt::format(" Besides, {:g} were absorbed, expected {:.0f}.", absorbed, right);
  return figure;
}

void judge_cells(const SampleCase& c, const Rows& rows) {
  std::vector<double> counts(rings * sectors + 1);
  double below = 0, none = 0;
  for (std::size_t i = 0; i < draws; ++i) {
    if (rows.at(i, 0) == 0) {
      none += 1;
      counts.back() += 1;
      continue;
    }
    const Double3 w = local(rows, i);
    if (!(w.z > 0)) {
      below += 1;
      continue;
    }
    const double v = std::atan2(w.y, w.x) / (2 * pi);
    const int ring = std::min(static_cast<int>(w.z * rings), rings - 1);
    const int sector = std::clamp(static_cast<int>((v < 0 ? v + 1 : v) * sectors), 0, sectors - 1);
    counts[static_cast<std::size_t>(ring * sectors + sector)] += 1;
  }
  judge(holds("directions below the horizon, " + title(c), below == 0,
              fmt::format("{:g} of {}", below, draws), "none", {kept_below}));
  double statistic = 0, freedom = -1, found = 0, expected = 0;
  const std::vector<double> mass = cell_masses(c);
  double empty = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    found += counts[i];
    expected += mass[i] * draws;
    empty += counts[i] == 0 && mass[i] * draws > 50 ? 1 : 0;
    if (expected < 100 && i + 1 < counts.size()) continue;
    if (expected > 0) {
      statistic += (found - expected) * (found - expected) / expected;
      freedom += 1;
    }
    found = expected = 0;
  }
  Verdict verdict;
  verdict.what = "cells of directions, " + title(c);
  verdict.measured = fmt::format("chi-square {:.5g}", statistic);
  verdict.expected = fmt::format("{:g} ± {:.3g}", freedom, std::sqrt(2 * freedom));
  conclude(verdict, fmt::format("chi-square {:.5g}", statistic),
           carlo::chi_square_two_sided(statistic, freedom));
  if (!verdict.passed) verdict.figure = cells_picture(counts, mass);
  if (!verdict.passed && none == 0) verdict.diagnoses.push_back(never_absorbs);
  if (!verdict.passed && empty >= 8) verdict.diagnoses.push_back(reused);
  judge(verdict);
}

void judge_weights(const SampleCase& c, const Rows& rows) {
  const PhongCase material = phong_cases()[c.material];
  const PhongTheory theory(material);
  const Double3 normal(tilted_frame().n), wo = world_wo(c.degrees);
  double wrong = 0, no_pdf = 0, no_cosine = 0, wrong_pdf = 0, some = 0;
  const double tolerance = 1e-4 + 2e-5 * std::sqrt(theory.n);
  for (std::size_t i = 0; i < draws; ++i) {
    if (rows.at(i, 0) == 0) continue;
    const Double3 wi(rows.at(i, 1), rows.at(i, 2), rows.at(i, 3));
    const double cosine = glm::dot(normal, wi);
    if (!(cosine > 1e-3)) continue;
    some += 1;
    const double f = theory.f(normal, wo, wi), density = theory.pdf(normal, wo, wi);
    const double weight = rows.at(i, 4), right = f * cosine / density;
    wrong += std::abs(weight - right) <= tolerance * right ? 0 : 1;
    no_pdf += std::abs(weight - f * cosine) <= tolerance * f * cosine ? 1 : 0;
    no_cosine += std::abs(weight - f / density) <= tolerance * f / density ? 1 : 0;
    wrong_pdf += std::abs(rows.at(i, 5) - density) <= tolerance * density ? 0 : 1;
  }
  std::vector<Diagnosis> diagnoses;
  if (no_pdf > 0.9 * some) diagnoses.push_back(weight_without_pdf);
  if (no_cosine > 0.9 * some) diagnoses.push_back(weight_without_cosine);
  // 1 sample in 1000 may lie where rounding makes much of a lobe's edge.
  judge(holds("weights f cos/pdf, " + title(c), wrong <= 1e-3 * some,
              fmt::format("{:g} of {:g} differ", wrong, some), "all equal", diagnoses));
  judge(holds("densities that come with samples, " + title(c), wrong_pdf <= 1e-3 * some,
              fmt::format("{:g} of {:g} differ", wrong_pdf, some), "all equal to pdf()"));
}

}  // namespace

TEST_CASE("Lab 8.3: samples follow the density, absorption and the horizon included",
          "[lab08][ex3]") {
  for (const SampleCase& c : {SampleCase{0, 0}, {2, 80}, {3, 60}, {4, 30}, {4, 85}}) {
    const Rows rows = samples_of(c);
    judge_cells(c, rows);
    judge_weights(c, rows);
  }
}

TEST_CASE("Lab 8.3: mean weights are reflectances, to n = 1e6", "[lab08][ex3]") {
  for (const SampleCase& c : {SampleCase{1, 60}, {2, 80}, {4, 60}, {5, 80}}) {
    const PhongCase material = phong_cases()[c.material];
    const double albedo =
        static_cast<double>(material.kd) +
        static_cast<double>(material.ks) *
            (material.n < 1e5f ? specular_albedo(static_cast<int>(material.n), c.degrees)
                               : std::cos(c.degrees * pi / 180));
    // With n = 1e6 the weight is cos(80 degrees), or 0 with probability 1/10: the sd is below 0.06.
    const double sd = material.n < 1e5f ? PhongTheory(material).weights(c.degrees).sd() : 0.06;
    judge(mean_is("the mean weight, " + title(c), column(samples_of(c), 4), {albedo, sd}));
  }
}

TEST_CASE("Lab 8.3: the lobe's shape at n = 1e6", "[lab08][ex3]") {
  const SampleCase c{5, 30};
  const Rows rows = samples_of(c);
  const Double3 mirror = PhongTheory::mirrored(Double3(tilted_frame().n), world_wo(c.degrees));
  std::vector<double> heights;
  for (std::size_t i = 0; i < draws; ++i) {
    if (rows.at(i, 0) == 0) continue;
    heights.push_back(cos_power({rows.at(i, 1), rows.at(i, 2), rows.at(i, 3)}, mirror, 1e6 + 1));
    if (heights.size() == 5000) break;
  }
  judge(uniform_on("cos^(n+1) of the angles to the mirror direction", heights, 0, 1));
}
