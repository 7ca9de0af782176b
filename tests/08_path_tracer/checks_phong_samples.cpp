// Checks of the samples of exercise 8.3: 100 000 directions per case; chi-square over 64 cells
// against the density's integrals (cells off by 6 % each, rms, are detected with power .999), and
// the mean weight against the reflectance in closed form.

#include "08_path_tracer/phong_cells.h"
#include "grader/judge/figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis lobes_confused{
    "lobes-confused",
    "a lobe is chosen with another probability than that of lobe_probabilities(): compare u_lobe "
    "with one probability, then with the sum of both."};
const Diagnosis redrawn{"below-horizon-redrawn",
                        "directions below the horizon are drawn again or flipped: they "
                        "contribute nothing, so return nothing."};
const Diagnosis all_of_f{"all-of-f-over-one-density",
                         "the weight is the whole f over the density of one lobe alone: "
                         "directions that both lobes can draw are counted twice."};
const Diagnosis weight_of_one{"weight-of-one-lobe",
                              "this is the weight of the drawn lobe alone: unbiased, but not the "
                              "required one, the whole f over the density of both lobes."};
const Diagnosis weight_without_pdf{
    "weight-without-pdf", "the weight is f cos(theta): it has to be divided by the density."};
const Diagnosis weight_without_cosine{"weight-without-cosine", "the weight lacks the cosine."};
const Diagnosis kept_below{"below-horizon-kept",
                           "directions below the horizon are returned: they contribute nothing, "
                           "and must not be drawn again."};
const Diagnosis reused{"random-number-reused",
                       "u_lobe is used for the direction as well as for the lobe: large parts of "
                       "the hemisphere are never reached."};
const Diagnosis never_absorbs{"never-absorbs",
                              "a direction is always returned: the rest of the probability is "
                              "absorption."};

const Diagnosis wo_not_local{
    "wo-not-local",
    "the lobe is drawn for wo in world coordinates: lab 7 has the normal along z, and wo has to "
    "be transformed into that frame first."};
const Diagnosis not_turned{"direction-not-turned",
                           "the direction stays in the frame in which the normal is z: it has to "
                           "be transformed to the world."};
const Diagnosis drawn_about_normal{
    "lobe-drawn-about-the-normal",
    "the lobe's directions surround the normal, not the mirror direction of wo."};
const Diagnosis drawn_about_wo{
    "lobe-drawn-about-wo", "the lobe's directions surround wo itself, not its mirror direction."};

struct SampleCase {
  std::size_t material;  ///< into phong_cases()
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

/// The mistake that explains where the lobe was drawn.
std::vector<Diagnosis> of_place(const SampleCase& c, const PhongTheory& theory,
                                const std::vector<double>& lobe,
                                const std::vector<double>& counts) {
  if (theory.ks == 0 || theory.n == 0) return {};
  const auto fits = [&](const std::vector<double>& other) {
    return fit_of(counts, cell_masses(theory, other)).good();
  };
  if (fits(lobe_masses(theory.n, 0))) return {drawn_about_normal};
  std::vector<double> turned = lobe;
  for (auto ring = turned.begin(); ring != turned.end(); ring += sectors)
    std::rotate(ring, ring + sectors / 2, ring + sectors);
  if (fits(turned)) return {drawn_about_wo};
  // The lobe's azimuth then depends on the frame; its elevation does not.
  const double degrees = std::acos(world_wo(c.degrees).z) * 180 / pi;
  const std::vector<double> mass = cell_masses(theory, lobe_masses(theory.n, degrees));
  if (fit_of(by_rings(counts), by_rings(mass)).good()) return {wo_not_local};
  return {};
}

/// The mistake that explains counts that do not fit `mass`.
std::vector<Diagnosis> of_cells(const PhongTheory& right, const std::vector<double>& lobe,
                                const std::vector<double>& counts,
                                const std::vector<double>& mass) {
  const double none = counts.back() / draws;
  double empty = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    empty += counts[i] == 0 && mass[i] * draws > 50 ? 1 : 0;
  if (empty >= 8 && std::abs(none - mass.back()) < 0.1) return {reused};
  const double sum = right.kd + right.ks;
  const auto fits = [&](double diffuse, double specular) {
    PhongTheory other = right;
    other.kd = diffuse;
    other.ks = specular;
    return fit_of(counts, cell_masses(other, lobe)).good();
  };
  if (fits(right.kd / sum, right.ks / sum) || fits(right.kd, 1 - right.kd)) return {never_absorbs};
  if (fits(right.kd, std::max(right.ks - right.kd, 0.0)) ||
      fits(right.kd, std::min(sum, 1 - right.kd)) || fits(right.ks, right.kd)) {
    return {lobes_confused};
  }
  const double absorbed = 1 - sum, sd = std::sqrt(absorbed * (1 - absorbed) / draws);
  if (std::abs(none - absorbed) <= 6 * sd && mass.back() > absorbed + 0.01) return {redrawn};
  return {};
}

/// True if f and pdf() are right by themselves; if not, samples are wrong because of them.
bool functions_are_right(const SampleCase& c) {
  const PhongTheory theory(phong_cases()[c.material]);
  const std::vector<DirectionPair> pairs = direction_pairs(phong_cases()[c.material].n);
  const Rows rows =
      probe("Lab 8.3 values", {.numbers = {{"case", static_cast<double>(c.material)}}},
            {.rows = pairs.size(),
             .columns = 2,
             .finite = false,
             .of = name_of(phong_cases()[c.material])});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Double3 normal(pairs[i].normal), wo(pairs[i].wo), wi(pairs[i].wi);
    // On the very edge of the hemisphere or of the lobe rounding decides.
    if (std::abs(glm::dot(normal, wi)) < 1e-5) continue;
    if (std::abs(glm::dot(PhongTheory::mirrored(normal, wo), wi)) < 1e-5) continue;
    const auto is = [&](double measured, double value) {
      return std::abs(measured - value) <= 1e-3 * value + 1e-6;
    };
    if (!is(rows.at(i, 0), theory.f(normal, wo, wi))) return false;
    if (!is(rows.at(i, 1), theory.pdf(normal, wo, wi))) return false;
  }
  return true;
}

/// Names the mistakes that explain wrong cells; `unturned` if no direction lies below the world's
/// horizon.
void name_cells(Verdict& verdict, const SampleCase& c, const std::vector<double>& counts,
                bool unturned) {
  verdict.looked_for = {wo_not_local,   not_turned, drawn_about_normal, drawn_about_wo, reused,
                        lobes_confused, redrawn,    never_absorbs};
  if (!functions_are_right(c)) return;
  const PhongTheory theory(phong_cases()[c.material]);
  const std::vector<double> lobe = lobe_masses(theory.n, c.degrees);
  // With such wide directions the normal's hemisphere contains many that point down.
  if (unturned && counts.back() < 0.9 * draws) {
    verdict.diagnoses = {not_turned};
    return;
  }
  verdict.diagnoses = of_place(c, theory, lobe, counts);
  if (verdict.diagnoses.empty())
    verdict.diagnoses = of_cells(theory, lobe, counts, cell_masses(theory, lobe));
}

/// Without the last cell, which counts absorbed samples.
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
  bool unturned = true;
  for (std::size_t i = 0; i < draws; ++i) {
    unturned = unturned && rows.at(i, 3) >= 0;
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
  if (!verdict.passed && below == 0) name_cells(verdict, c, counts, unturned);
  judge(verdict);
}

/// Counts samples whose weights are not f cos/pdf, and those that typical mistakes explain.
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
  // 1 sample in 1000 may lie where rounding has a large effect at a lobe's edge.
  const bool right = weights.wrong <= 1e-3 * weights.some;
  judge(holds("weights f cos/pdf, " + title(c), right,
              fmt::format("{:g} of {:g} differ", weights.wrong, weights.some), "all equal",
              right || !functions_are_right(c) ? std::vector<Diagnosis>{} : weights.diagnoses()));
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
