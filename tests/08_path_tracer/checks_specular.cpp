// Checks of exercise 8.7: exact values, but for the last world.

#include "08_path_tracer/theory.h"
#include "08_path_tracer/views.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis eta_inverted{"eta-inverted",
                             "the index ratio is inverted: eta is wo's side over the one beyond."};
const Diagnosis one_polarisation{"one-polarisation-only",
                                 "unpolarised light: the mean of both squares."};
const Diagnosis no_total{"total-reflection-missing",
                         "where eta sin(theta) reaches 1 nothing is refracted."};
const Diagnosis no_radiance_factor{"radiance-not-scaled",
                                   "a pencil of light that is refracted changes its solid angle by "
                                   "eta^2, and its radiance with it."};
const Diagnosis radiance_inverted{"radiance-scaling-inverted",
                                  "eta^2, not 1/eta^2: seen from outside, radiance within glass is "
                                  "divided by the square of its index."};
const Diagnosis divided_twice{"fresnel-in-weight",
                              "reflection is chosen with probability F: the factor F and the "
                              "division by that probability cancel."};
const Diagnosis not_mirrored{"mirror-direction-wrong", "the mirror direction is 2 (n.wo) n - wo."};
const Diagnosis front_ignored{"inside-not-told-from-outside",
                              "within the glass (surface.front is false) int_ior is on wo's side."};
const Diagnosis emission_lost{"emission-behind-glass-lost",
                              "after a mirror or glass emission counts: no light was sampled "
                              "there."};
const Diagnosis lamp_black_in_mirror{"emission-in-mirror-lost",
                                     "a lamp that a mirror's ray meets counts, as if the camera "
                                     "saw it, whether the mirror itself was "
                                     "asked with emission or without: no light was sampled there."};

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

constexpr std::size_t n_paths = 50'000;

Rows trace(std::map<std::string, double> numbers, std::size_t count = 2000) {
  numbers.insert({{"method", 3}, {"emission", 1}, {"degrees", 0}});
  const Params params{.n = static_cast<std::int64_t>(count), .numbers = std::move(numbers)};
  return probe("Lab 8 paths", params, {.rows = count, .columns = 3, .of = view_text(params)});
}

}  // namespace

TEST_CASE("Lab 8.7: Fresnel's reflectance", "[lab08][ex7]") {
  for (const double eta : {1 / 1.5, 1.5, 1 / 1.33, 1.0}) {
    for (const double degrees : {0.0, 30.0, 40.0, 56.309932, 75.0, 89.0, 90.0}) {
      const double c = std::cos(degrees * pi / 180), exact = fresnel_exact(c, eta);
      const Rows rows =
          probe("Lab 8.7 fresnel", {.numbers = {{"cos", c}, {"eta", eta}}},
                {.finite = false, .of = fmt::format("{:g} degrees, eta = {:.4g}", degrees, eta)});
      Suspects suspects{{fresnel_exact(c, 1 / eta), eta_inverted}};
      if (degrees > 10) suspects.push_back({s_only(c, eta), one_polarisation});
      Verdict verdict =
          equals(fmt::format("the reflectance at {:g} degrees, eta = {:.4g}", degrees, eta),
                 rows.at(0, 0), exact, 2e-5, suspects);
      if (!verdict.passed && exact == 1 && std::isnan(rows.at(0, 0)))
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
      const Rows rows = probe("Lab 8.7 refract", {.numbers = {{"degrees", degrees}, {"eta", eta}}},
                              {.columns = 4});
      const std::string what = fmt::format("light at {:g} degrees, eta = {:.4g},", degrees, eta);
      if ((beyond < 1) != (rows.at(0, 0) == 1)) {
        judge(holds(what, false, rows.at(0, 0) == 1 ? "is refracted" : "is not refracted",
                    beyond < 1 ? "refracted" : "reflected totally",
                    beyond < 1 ? std::vector<Diagnosis>{} : std::vector{no_total}));
        return;
      }
      if (beyond >= 1) continue;
      const Double3 wt(rows.at(0, 1), rows.at(0, 2), rows.at(0, 3));
      const Double3 exact(-beyond, 0, -std::sqrt(1 - beyond * beyond));
      const double error = glm::length(wt - exact);
      worst = std::max(worst, error);
      if (error <= 1e-4) continue;
      const double other = sine / eta;
      const bool inverted = std::abs(wt.x + other) < 1e-3;
      judge(holds(what, false, fmt::format("goes to ({:.4g}, {:.4g}, {:.4g})", wt.x, wt.y, wt.z),
                  fmt::format("({:.4g}, 0, {:.4g})", exact.x, exact.z),
                  inverted ? std::vector{eta_inverted} : std::vector<Diagnosis>{}));
      return;
    }
  }
  judge(equals("the largest error of a refracted direction", worst, 0, 1e-4));
}

TEST_CASE("Lab 8.7: mirrors and glass, from both sides", "[lab08][ex7]") {
  for (const double front : {1.0, 0.0}) {
    for (const double degrees : {0.0, 30.0, 60.0}) {
      const std::string side =
          fmt::format("{:g} degrees from {}", degrees, front == 1 ? "outside" : "within");
      const Rows rows =
          probe("Lab 8.7 specular", {.numbers = {{"front", front}, {"degrees", degrees}}},
                {.rows = 65, .columns = 7, .finite = false, .of = side});
      const double sine = std::sin(degrees * pi / 180), cosine = std::cos(degrees * pi / 180);
      const auto direction = [&](std::size_t i) {
        return Double3(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
      };
      const Double3 mirrored(-sine, 0, cosine);
      if (front == 1) {
        judge(is_so("the mirror's direction, " + side, glm::length(direction(0) - mirrored) <= 1e-5,
                    "another", "2 (n.wo) n - wo", {not_mirrored}));
        judge(all_equal("the mirror's weight and pdf, " + side,
                        std::vector{rows.at(0, 3), rows.at(0, 4), rows.at(0, 5), rows.at(0, 6)},
                        std::vector{0.5, 0.6, 0.7, 0.0}, 1e-6));
      }
      const double eta = front == 1 ? 1 / 1.5 : 1.5, F = fresnel_exact(cosine, eta);
      const double other = fresnel_exact(cosine, 1 / eta);
      double wrong = 0, unscaled = 0, inverse = 0, reflected_weight = 0, swapped = 0;
      for (std::size_t i = 1; i <= 64; ++i) {
        const double u = (static_cast<double>(i) - 0.5) / 64, weight = rows.at(i, 3);
        const bool reflects = u < F;
        const Double3 beyond(-eta * sine, 0,
                             -std::sqrt(std::max(0.0, 1 - eta * eta * sine * sine)));
        const double way = glm::length(direction(i) - (reflects ? mirrored : beyond));
        const double right = reflects ? 1 : eta * eta;
        wrong +=
            way <= 1e-4 && std::abs(weight - right) <= 1e-5 * right && rows.at(i, 6) == 0 ? 0 : 1;
        unscaled += !reflects && std::abs(weight - 1) <= 1e-5 ? 1 : 0;
        inverse += !reflects && std::abs(weight - 1 / right) <= 1e-5 ? 1 : 0;
        reflected_weight += reflects && std::abs(weight - F) <= 1e-5 && F < 1 ? 1 : 0;
        const bool would = u < other;
        const Double3 there(-sine / eta, 0, -std::sqrt(std::max(0.0, 1 - sine * sine / eta / eta)));
        swapped += glm::length(direction(i) - (would ? mirrored : there)) <= 1e-4 ? 1 : 0;
      }
      std::vector<Diagnosis> diagnoses;
      if (unscaled > 0) diagnoses.push_back(no_radiance_factor);
      if (inverse > 0) diagnoses.push_back(radiance_inverted);
      if (reflected_weight > 0) diagnoses.push_back(divided_twice);
      if (swapped == 64 && degrees > 0)
        diagnoses.push_back(front == 0 ? front_ignored : eta_inverted);
      judge(holds("glass at " + side, wrong == 0, fmt::format("{:g} of 64 samples differ", wrong),
                  fmt::format("reflection for u < {:.4g}, weight 1; else refraction, weight {:.4g}",
                              F, eta * eta),
                  diagnoses));
    }
  }
}

TEST_CASE("Lab 8.7: what is seen in a mirror and through glass", "[lab08][ex7]") {
  const Rows mirror =
      trace({{"place", mirror_ball}, {"r", 0.5}, {"g", 0.6}, {"b", 0.7}, {"degrees", 30}});
  judge(all_equal("a mirror ball under the sky",
                  std::vector(mirror.values.begin(), mirror.values.begin() + 3),
                  std::vector{0.5, 0.6, 0.7}, 1e-5));
  for (const double degrees : {0.0, 70.0}) {
    const std::vector<double> seen =
        column(trace({{"place", glass_ball}, {"degrees", degrees}}), 0);
    judge(all_equal(fmt::format("the sky through a glass ball, {:g} degrees", degrees), seen,
                    std::vector<double>(seen.size(), 1.0), 1e-3, {no_radiance_factor}));
  }
}

TEST_CASE("Lab 8.7: a lamp is seen in a mirror, too", "[lab08][ex7]") {
  // Without the emission of the first surface as well, which is the mirror and emits nothing.
  for (const double emission : {1.0, 0.0}) {
    const Rows rows = trace(
        {{"place", wall_in_mirror}, {"r", 0.5}, {"g", 0.6}, {"b", 0.7}, {"emission", emission}});
    const bool black =
        std::all_of(rows.values.begin(), rows.values.end(), [](double x) { return x == 0; });
    judge(all_equal(emission == 1 ? "a glowing wall in a mirror"
                                  : "a glowing wall in a mirror, without the mirror's emission",
                    std::vector(rows.values.begin(), rows.values.begin() + 3),
                    std::vector{0.5, 0.6, 0.7}, 1e-5,
                    black ? std::vector{lamp_black_in_mirror} : std::vector<Diagnosis>{}));
  }
}

TEST_CASE("Lab 8.7: emission counts behind mirrors and glass", "[lab08][ex7]") {
  // Behind the ball a black wall that emits 1: every path ends there, whatever its way.
  const std::vector<double> seen = column(trace({{"place", behind_glass}}), 0);
  judge(all_equal("a glowing wall through a glass ball", seen,
                  std::vector<double>(seen.size(), 1.0), 1e-3,
                  std::all_of(seen.begin(), seen.end(), [](double x) { return x == 0; })
                      ? std::vector{emission_lost}
                      : std::vector<Diagnosis>{}));
  // The sd is a bound: three halves of what a right solution shows (no closed form).
  judge(mean_is(
      "radiance in a furnace around a glass ball",
      column(trace({{"place", with_glass}, {"r", 0.5}, {"g", 0.5}, {"b", 0.5}}, n_paths), 0),
      {2, 2}));
}
