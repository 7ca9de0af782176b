// Checks of what exercise 8.3 samples: 100 000 directions a case; chi-square over 64 cells against
// the density's integrals (cells off by 6 % each, rms, are caught with power .999), the mean weight
// against the reflectance in closed form.

#include "08_path_tracer/theory.h"
#include "grader/judge/figures.h"
#include "stats/distributions.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis lobes_confused{"lobes-confused",
                               "a lobe is taken with another chance than lobe_chances() says: "
                               "u_lobe is compared with one chance, then with the sum of both."};
const Diagnosis redrawn{"below-horizon-redrawn",
                        "directions below the horizon come back as others, drawn again or turned "
                        "up: they carry nothing, and nothing is to be returned."};
const Diagnosis all_of_f{"all-of-f-over-one-density",
                         "the weight is all of f over the density of one lobe alone: each "
                         "direction that either can make is counted twice."};
const Diagnosis weight_of_one{"weight-of-one-lobe",
                              "this is the weight of the lobe that was drawn, honest but not what "
                              "is asked for: all of f over the density of both lobes."};
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

constexpr std::size_t draws = 100'000;

struct SampleCase {
  std::size_t material;  ///< of phong_cases()
  double degrees;
};

std::string title(const SampleCase& c) {
  return fmt::format("{}, wo at {:g} degrees", name_of(phong_cases()[c.material]), c.degrees);
}

Rows samples_of(const SampleCase& c) {
  return probe(
      "Lab 8.3 samples",
      {.n = draws, .numbers = {{"case", static_cast<double>(c.material)}, {"degrees", c.degrees}}},
      {.rows = draws, .columns = 6, .of = title(c)});
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

/// The part of the lobe, (n + 1)/(2 pi) cos^n about the mirror direction, that each cell holds.
std::vector<double> lobe_masses(double n, double degrees) {
  const double angle = degrees * pi / 180;
  const Double3 mirror(-std::sin(angle), 0, std::cos(angle));
  std::vector<double> mass(rings * sectors);
  over_turns(800, [&](double u, double cosine, double sine, double weight) {
    // The mirror direction has no y: what lies at -y is the same again.
    if (sine < 0) return;
    const double r = std::sqrt(1 - u * u), v = std::atan2(sine, cosine) / (2 * pi);
    const auto ring = static_cast<std::size_t>(u * rings) * sectors;
    const auto sector = static_cast<std::size_t>(v * sectors);
    const double part = weight * (n + 1) * cos_power(mirror, {r * cosine, r * sine, u}, n);
    mass[ring + sector] += part;
    mass[ring + sectors - 1 - sector] += part;
  });
  return mass;
}

/// Of the density whose chances are the theory's kd and ks; the last is what no cell gets.
std::vector<double> cell_masses(const PhongTheory& theory, const std::vector<double>& lobe) {
  std::vector<double> mass;
  mass.reserve(lobe.size() + 1);
  double none = 1;
  for (std::size_t i = 0; i < lobe.size(); ++i) {
    const std::size_t whole = i / sectors;
    const auto ring = static_cast<double>(whole);
    const double diffuse = (2 * ring + 1) / (rings * rings) / sectors;
    mass.push_back(theory.kd * diffuse + theory.ks * lobe[i]);
    none -= mass.back();
  }
  mass.push_back(none);
  return mass;
}

struct Fit {
  double statistic = 0, freedom = -1;
  bool good() const {
    return carlo::chi_square_two_sided(statistic, freedom) >= comparison_alpha();
  }
};

/// Chi-square of the counts; neighbouring cells are pooled to 100 expected samples.
Fit fit_of(const std::vector<double>& counts, const std::vector<double>& mass) {
  Fit fit;
  double found = 0, expected = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    found += counts[i];
    expected += mass[i] * draws;
    if (expected < 100 && i + 1 < counts.size()) continue;
    if (expected > 0) {
      fit.statistic += (found - expected) * (found - expected) / expected;
      fit.freedom += 1;
    }
    found = expected = 0;
  }
  return fit;
}

/// What counts that do not fit `mass` fit instead.
std::vector<Diagnosis> of_cells(const PhongTheory& right, const std::vector<double>& lobe,
                                const std::vector<double>& counts,
                                const std::vector<double>& mass) {
  double empty = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    empty += counts[i] == 0 && mass[i] * draws > 50 ? 1 : 0;
  if (empty >= 8) return {reused};
  const double sum = right.kd + right.ks;
  const auto fits = [&](double diffuse, double specular) {
    PhongTheory other = right;
    other.kd = diffuse;
    other.ks = specular;
    return fit_of(counts, cell_masses(other, lobe)).good();
  };
  if (fits(right.kd / sum, right.ks / sum)) return {never_absorbs};
  if (fits(right.kd, std::max(right.ks - right.kd, 0.0)) ||
      fits(right.kd, std::min(sum, 1 - right.kd)) || fits(right.ks, right.kd)) {
    return {lobes_confused};
  }
  const double none = counts.back() / draws, absorbed = 1 - sum;
  const double sd = std::sqrt(absorbed * (1 - absorbed) / draws);
  if (std::abs(none - absorbed) <= 6 * sd && mass.back() > absorbed + 0.01) return {redrawn};
  return {};
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
  double below = 0;
  for (std::size_t i = 0; i < draws; ++i) {
    if (rows.at(i, 0) == 0) {
      counts.back() += 1;
      continue;
    }
    const Double3 w = local(rows, i);
    // At the horizon rounding decides.
    if (w.z < -1e-6) {
      below += 1;
      continue;
    }
    const double v = std::atan2(w.y, w.x) / (2 * pi);
    const int ring = std::clamp(static_cast<int>(w.z * rings), 0, rings - 1);
    const int sector = std::clamp(static_cast<int>((v < 0 ? v + 1 : v) * sectors), 0, sectors - 1);
    counts[static_cast<std::size_t>(ring * sectors + sector)] += 1;
  }
  judge(holds("directions below the horizon, " + title(c), below == 0,
              fmt::format("{:g} of {}", below, draws), "none", {kept_below}));
  const PhongTheory theory(phong_cases()[c.material]);
  const std::vector<double> lobe = lobe_masses(theory.n, c.degrees);
  const std::vector<double> mass = cell_masses(theory, lobe);
  const Fit fit = fit_of(counts, mass);
  Verdict verdict = chi_square_fits("cells of directions, " + title(c), fit.statistic, fit.freedom);
  verdict.effect = effect_on_cells(fit.statistic, fit.freedom, draws);
  if (!verdict.passed) verdict.figure = cells_picture(counts, mass);
  if (!verdict.passed && below == 0) verdict.diagnoses = of_cells(theory, lobe, counts, mass);
  judge(verdict);
}

/// What samples' weights were made of, instead of f cos/pdf.
struct Weights {
  double some = 0, wrong = 0, no_pdf = 0, no_cosine = 0, one_lobe = 0, all_over_one = 0;

  void add(const PhongTheory& t, double f, double density, double cosine, double weight,
           double tolerance) {
    const auto is = [&](double value) { return std::abs(weight - value) <= tolerance * value; };
    some += 1;
    wrong += is(f * cosine / density) ? 0 : 1;
    no_pdf += is(f * cosine) ? 1 : 0;
    no_cosine += is(f / density) ? 1 : 0;
    if (t.kd == 0 || t.ks == 0) return;
    const double diffuse = t.kd * cosine / pi, specular = density - diffuse;
    one_lobe += is(1) || is((t.n + 2) / (t.n + 1) * cosine) ? 1 : 0;
    all_over_one += is(f * cosine / diffuse) || is(f * cosine / specular) ? 1 : 0;
  }

  std::vector<Diagnosis> diagnoses() const {
    std::vector<Diagnosis> found;
    if (no_pdf > 0.9 * some) found.push_back(weight_without_pdf);
    if (no_cosine > 0.9 * some) found.push_back(weight_without_cosine);
    if (one_lobe > 0.9 * some) found.push_back(weight_of_one);
    if (all_over_one > 0.9 * some) found.push_back(all_of_f);
    return found;
  }
};

void judge_weights(const SampleCase& c, const Rows& rows) {
  const PhongTheory theory(phong_cases()[c.material]);
  const Double3 normal(tilted_frame().n), wo = world_wo(c.degrees);
  Weights weights;
  double wrong_pdf = 0;
  const double tolerance = 1e-4 + 2e-5 * std::sqrt(theory.n);
  for (std::size_t i = 0; i < draws; ++i) {
    if (rows.at(i, 0) == 0) continue;
    const Double3 wi(rows.at(i, 1), rows.at(i, 2), rows.at(i, 3));
    const double cosine = glm::dot(normal, wi);
    if (!(cosine > 1e-3)) continue;
    const double density = theory.pdf(normal, wo, wi);
    weights.add(theory, theory.f(normal, wo, wi), density, cosine, rows.at(i, 4), tolerance);
    wrong_pdf += std::abs(rows.at(i, 5) - density) <= tolerance * density ? 0 : 1;
  }
  // 1 sample in 1000 may lie where rounding makes much of a lobe's edge.
  judge(holds("weights f cos/pdf, " + title(c), weights.wrong <= 1e-3 * weights.some,
              fmt::format("{:g} of {:g} differ", weights.wrong, weights.some), "all equal",
              weights.diagnoses()));
  judge(holds("densities that come with samples, " + title(c), wrong_pdf <= 1e-3 * weights.some,
              fmt::format("{:g} of {:g} differ", wrong_pdf, weights.some), "all equal to pdf()"));
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
