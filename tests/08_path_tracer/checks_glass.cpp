// Checks of exercise 8.7: the laws of mirrors and glass, all exact values.

#include "08_path_tracer/theory.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis eta_inverted{"eta-inverted",
                             "the index ratio is inverted: eta is the index on wo's side over "
                             "the one on the other side."};
const Diagnosis one_polarisation{"one-polarisation-only",
                                 "only one polarisation is used: unpolarised light has the mean "
                                 "of both squares."};
const Diagnosis both_polarisations{
    "polarisations-not-averaged",
    "unpolarised light is half of each polarisation: the mean of both "
    "squares, not their sum."};
const Diagnosis mean_squared{"polarisations-averaged-before-the-square",
                             "the mean of both amplitudes is squared: power is an amplitude's "
                             "square, so square each, then take the mean."};
const Diagnosis not_across{"refracted-to-wos-side",
                           "the refracted direction's tangential part points to wo's side: light "
                           "goes on past the normal, so that part changes its sign."};
const Diagnosis no_total{"total-reflection-missing",
                         "where eta sin(theta) reaches 1 nothing is refracted."};
const Diagnosis no_radiance_factor{"radiance-not-scaled",
                                   "refraction changes the solid angle of a pencil of light by "
                                   "eta^2, and with it the radiance."};
const Diagnosis radiance_inverted{"radiance-scaling-inverted",
                                  "eta^2, not 1/eta^2: seen from outside, radiance within glass is "
                                  "divided by the square of its index."};
const Diagnosis divided_twice{"fresnel-in-weight",
                              "reflection is chosen with probability F: the factor F and the "
                              "division by that probability cancel."};
const Diagnosis not_mirrored{"mirror-direction-wrong", "the mirror direction is 2 (n.wo) n - wo."};
const Diagnosis front_ignored{"inside-not-told-from-outside",
                              "within the glass (surface.front is false) int_ior is on wo's side."};

double fresnel_exact(double cos_i, double eta) {
  const double sin2 = eta * eta * (1 - cos_i * cos_i);
  if (sin2 >= 1) return 1;
  const double cos_t = std::sqrt(1 - sin2);
  const double s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return (s * s + p * p) / 2;
}

double s_only(double cos_i, double eta) {
  const double cos_t = std::sqrt(std::max(0.0, 1 - eta * eta * (1 - cos_i * cos_i)));
  const double s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return s * s;
}

/// The results of typical mistakes in fresnel().
Suspects fresnel_suspects(double cos_i, double eta) {
  const double exact = fresnel_exact(cos_i, eta), s = s_only(cos_i, eta);
  Suspects suspects{{fresnel_exact(cos_i, 1 / eta), eta_inverted}, {2 * exact, both_polarisations}};
  // The two amplitudes are of opposite sign, or not, by the convention of the formulas.
  const double cos_t = std::sqrt(std::max(0.0, 1 - eta * eta * (1 - cos_i * cos_i)));
  const double along = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const double across = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  if (exact < 1 && exact > 0) {
    for (const double sum : {across + along, across - along})
      suspects.push_back({sum * sum / 4, mean_squared});
  }
  // At normal incidence the two polarisations are the same.
  if (cos_i < 0.98 && exact < 1) {
    suspects.push_back({s, one_polarisation});
    suspects.push_back({2 * exact - s, one_polarisation});
  }
  return suspects;
}

double fresnel_of(double cos_i, double eta, double degrees) {
  return probe("Lab 8.7 fresnel", {.numbers = {{"cos", cos_i}, {"eta", eta}}},
               {.finite = false, .of = fmt::format("{:g} degrees, eta = {:.4g}", degrees, eta)})
      .at(0, 0);
}

/// The refracted direction in the plane of x and z, if there is one.
struct Refracted {
  bool is_there;
  Double3 direction;
};
Refracted refracted(double degrees, double eta) {
  const Rows rows =
      probe("Lab 8.7 refract", {.numbers = {{"degrees", degrees}, {"eta", eta}}}, {.columns = 4});
  return {rows.at(0, 0) == 1, {rows.at(0, 1), rows.at(0, 2), rows.at(0, 3)}};
}

/// True if fresnel() and refract() are right by themselves, at the angles used for glass; if not,
/// glass is wrong because of them.
bool laws_are_right() {
  for (const double eta : {1 / 1.5, 1.5}) {
    for (const double degrees : {0.0, 30.0, 60.0}) {
      const double c = std::cos(degrees * pi / 180), beyond = eta * std::sin(degrees * pi / 180);
      if (!(std::abs(fresnel_of(c, eta, degrees) - fresnel_exact(c, eta)) <= 2e-5)) return false;
      const Refracted light = refracted(degrees, eta);
      if (light.is_there != (beyond < 1)) return false;
      if (light.is_there && !(std::abs(light.direction.x + beyond) <= 1e-4)) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("Lab 8.7: Fresnel's reflectance", "[lab08][ex7]") {
  for (const double eta : {1 / 1.5, 1.5, 1 / 1.33, 1.0}) {
    for (const double degrees : {0.0, 30.0, 40.0, 56.309932, 75.0, 89.0, 90.0}) {
      const double c = std::cos(degrees * pi / 180), exact = fresnel_exact(c, eta);
      const double measured = fresnel_of(c, eta, degrees);
      Verdict verdict =
          equals(fmt::format("the reflectance at {:g} degrees, eta = {:.4g}", degrees, eta),
                 measured, exact, 2e-5, fresnel_suspects(c, eta));
      if (!verdict.passed && exact == 1 && std::isnan(measured))
        verdict.diagnoses.push_back(no_total);
      if (verdict.passed && degrees != 90) continue;
      judge(verdict);
      if (!verdict.passed) return;
    }
  }
}

TEST_CASE("Lab 8.7: refraction by Snell's law", "[lab08][ex7]") {
  double worst = 0;
  for (const double eta : {1 / 1.5, 1.5, 1.0}) {
    for (const double degrees : {0.0, 20.0, 41.0, 45.0, 80.0, 89.9}) {
      const double sine = std::sin(degrees * pi / 180), beyond = eta * sine;
      const auto [is_there, wt] = refracted(degrees, eta);
      const std::string what = fmt::format("light at {:g} degrees, eta = {:.4g},", degrees, eta);
      if ((beyond < 1) != is_there) {
        judge(holds(what, false, is_there ? "is refracted" : "is not refracted",
                    beyond < 1 ? "refracted" : "reflected totally",
                    beyond < 1 ? std::vector<Diagnosis>{} : std::vector{no_total}));
        return;
      }
      if (beyond >= 1) continue;
      const Double3 exact(-beyond, 0, -std::sqrt(1 - beyond * beyond));
      const double error = glm::length(wt - exact);
      worst = std::max(worst, error);
      if (error <= 1e-4) continue;
      const double other = sine / eta;
      const bool inverted = std::abs(wt.x + other) < 1e-3;
      const bool same_side = glm::length(wt - Double3(beyond, 0, exact.z)) <= 1e-4;
      judge(holds(what, false, fmt::format("goes to ({:.4g}, {:.4g}, {:.4g})", wt.x, wt.y, wt.z),
                  fmt::format("({:.4g}, 0, {:.4g})", exact.x, exact.z),
                  inverted    ? std::vector{eta_inverted}
                  : same_side ? std::vector{not_across}
                              : std::vector<Diagnosis>{}));
      return;
    }
  }
  judge(equals("the largest error of a refracted direction", worst, 0, 1e-4));
}

namespace {

/// Light that a surface reflects or refracts.
struct Slanted {
  double front, degrees;

  double sine() const { return std::sin(degrees * pi / 180); }
  double cosine() const { return std::cos(degrees * pi / 180); }
  double eta() const { return front == 1 ? 1 / 1.5 : 1.5; }
  std::string name() const {
    return fmt::format("{:g} degrees from {}", degrees, front == 1 ? "outside" : "within");
  }
  Double3 mirrored() const { return {-sine(), 0, cosine()}; }
  /// The direction that light takes for u, with this index ratio.
  Double3 direction(double u, double ratio) const {
    if (u < fresnel_exact(cosine(), ratio)) return mirrored();
    const double x = ratio * sine();
    return {-x, 0, -std::sqrt(std::max(0.0, 1 - x * x))};
  }
};

/// Statistics of the samples of glass in one view.
struct GlassSamples {
  double wrong = 0, unscaled = 0, inverse = 0, reflected_weight = 0, swapped = 0;

  GlassSamples(const Slanted& view, const Rows& rows) {
    const double eta = view.eta(), F = fresnel_exact(view.cosine(), eta);
    for (std::size_t i = 1; i <= 64; ++i) {
      const double u = (static_cast<double>(i) - 0.5) / 64, weight = rows.at(i, 3);
      const Double3 direction(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
      const double right = u < F ? 1 : eta * eta;
      const bool there = glm::length(direction - view.direction(u, eta)) <= 1e-4;
      const auto weighs = [=](double value) { return std::abs(weight - value) <= 1e-5 * value; };
      wrong += there && weighs(right) && rows.at(i, 6) == 0 ? 0 : 1;
      unscaled += there && u >= F && weighs(1) ? 1 : 0;
      inverse += there && u >= F && weighs(1 / right) ? 1 : 0;
      reflected_weight += there && u < F && weighs(F) && F < 1 ? 1 : 0;
      swapped += glm::length(direction - view.direction(u, 1 / eta)) <= 1e-4 ? 1 : 0;
    }
  }
};

/// At normal incidence the direction does not depend on the index ratio.
struct SeenGlass {
  Slanted view;
  GlassSamples samples;
  bool is_swapped() const { return samples.swapped == 64 && view.degrees > 0; }
};

/// The diagnosis for glass: if the ratio is wrong, so are the weights, in all views.
std::vector<Diagnosis> of_glass(const std::vector<SeenGlass>& views) {
  if (!laws_are_right()) return {};
  bool outside = false, within = false;
  for (const SeenGlass& seen : views)
    (seen.view.front == 1 ? outside : within) |= seen.is_swapped();
  if (outside) return {eta_inverted};
  if (within) return {front_ignored};
  std::vector<Diagnosis> diagnoses;
  const auto some = [&](double GlassSamples::*count) {
    return std::any_of(views.begin(), views.end(),
                       [&](const SeenGlass& seen) { return seen.samples.*count > 0; });
  };
  if (some(&GlassSamples::unscaled)) diagnoses.push_back(no_radiance_factor);
  if (some(&GlassSamples::inverse)) diagnoses.push_back(radiance_inverted);
  if (some(&GlassSamples::reflected_weight)) diagnoses.push_back(divided_twice);
  return diagnoses;
}

void judge_mirror(const Slanted& view, const Rows& rows) {
  const Double3 direction(rows.at(0, 0), rows.at(0, 1), rows.at(0, 2));
  judge(is_so("the mirror's direction, " + view.name(),
              glm::length(direction - view.mirrored()) <= 1e-5, "another", "2 (n.wo) n - wo",
              {not_mirrored}));
  judge(all_equal("the mirror's weight and pdf, " + view.name(),
                  std::vector{rows.at(0, 3), rows.at(0, 4), rows.at(0, 5), rows.at(0, 6)},
                  std::vector{0.5, 0.6, 0.7, 0.0}, 1e-6));
}

}  // namespace

TEST_CASE("Lab 8.7: mirrors and glass, from both sides", "[lab08][ex7]") {
  std::vector<SeenGlass> views;
  for (const double front : {1.0, 0.0}) {
    for (const double degrees : {0.0, 30.0, 60.0}) {
      const Slanted view{front, degrees};
      const Rows rows =
          probe("Lab 8.7 specular", {.numbers = {{"front", front}, {"degrees", degrees}}},
                {.rows = 65, .columns = 7, .finite = false, .of = view.name()});
      if (front == 1) judge_mirror(view, rows);
      views.push_back({view, GlassSamples(view, rows)});
    }
  }
  const bool right = std::all_of(views.begin(), views.end(),
                                 [](const SeenGlass& seen) { return seen.samples.wrong == 0; });
  const std::vector<Diagnosis> diagnoses = right ? std::vector<Diagnosis>{} : of_glass(views);
  for (const SeenGlass& seen : views) {
    const double eta = seen.view.eta();
    judge(holds("glass at " + seen.view.name(), seen.samples.wrong == 0,
                fmt::format("{:g} of 64 samples differ", seen.samples.wrong),
                fmt::format("reflection for u < {:.4g}, weight 1; else refraction, weight {:.4g}",
                            fresnel_exact(seen.view.cosine(), eta), eta * eta),
                diagnoses));
  }
}
