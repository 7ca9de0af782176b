// Checks of exercise 7.6: as in checks_samplers.cpp, and two closed forms with 200 000 directions:
// the part of the lobe below the horizon (a shift of .01 is detected with power .999) and the mean
// cosine above it, which is (n + 1)/(n + 2) times the albedo of a Phong surface.

#include "07_hemisphere/subject.h"

#include <cmath>
#include <numbers>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

/// w_0 = pi/2, w_1 = 1, w_(j+2) = w_j (j + 1)/(j + 2): the integral of sin^j over [0, pi/2].
double wallis(int j) {
  double w = j % 2 == 0 ? std::numbers::pi / 2 : 1;
  for (int i = j % 2; i + 2 <= j; i += 2)
    w *= (i + 1.0) / (i + 2.0);
  return w;
}

/// The fraction of the lobe's directions below the horizon.
double below_horizon(int n, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  double sum = 0;
  for (int j = n % 2 == 0 ? 1 : 0; j <= n - 1; j += 2)
    sum += std::pow(s, j) * wallis(j);
  return ((n % 2 == 0 ? theta : std::numbers::pi / 2) - c * sum) / std::numbers::pi;
}

/// The integral of (n + 2)/(2 pi) cos^n(alpha) cos(theta_i) over the hemisphere: the reflectance of
/// a Phong surface of k_s = 1 under a uniform sky.
double lobe_albedo(int n, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  double sum = 0;
  for (int j = n % 2; j <= n; j += 2)
    sum += std::pow(s, j) * wallis(j);
  const double half = n % 2 == 0 ? c / 2 : c * (1 - theta / std::numbers::pi);
  return half + c * c / std::numbers::pi * sum + std::pow(s, n + 2) * wallis(n) / std::numbers::pi;
}

const Diagnosis about_wo{"lobe-about-wo",
                         "the lobe surrounds wo itself: light would be reflected back to where it "
                         "came from."};
const Diagnosis about_normal{"lobe-about-the-normal",
                             "the lobe surrounds the normal, not the mirror direction."};
const Diagnosis below_surface{"mirror-direction-below",
                              "the mirror direction points into the surface: it must point away, "
                              "like wo."};
const Diagnosis below_changed{
    "below-horizon-changed",
    "the lobe's directions below the horizon are missing: flipped or drawn "
    "again, they change the density above; return them as they are."};
const Diagnosis cut_density{
    "density-ends-at-horizon",
    "the density leaves out the part below the horizon, where samples do fall: "
    "it no longer integrates to 1."};
const Diagnosis n_plus_2{
    "n-plus-two",
    "(n + 2)/(2 pi) normalises the lobe times a cosine, as in the BRDF; per solid "
    "angle it is n + 1."};
const Diagnosis about_surface_normal{"density-of-wi-and-normal",
                                     "the density takes its angle from the normal."};

constexpr std::size_t n_directions = 200'000;

/// Names the axis that the directions surround, if it is the wrong one.
void name_axis(Verdict& verdict, const Subject& subject, const std::vector<Double3>& world) {
  const Share right = power_law(subject.m());
  const auto surround = [&](Double3 axis) {
    return distributed("", local_to(Axes(axis), world), right).passed;
  };
  const Double3 wo(subject.wo);
  if (wo.z > 0.999) return;
  if (surround(wo)) verdict.diagnoses.push_back(about_wo);
  if (surround({0, 0, 1})) verdict.diagnoses.push_back(about_normal);
  if (surround(-wo) || surround({wo.x, wo.y, -wo.z})) verdict.diagnoses.push_back(below_surface);
}

std::function<double(Double3)> pdf_about(const Subject& subject, Double3 axis) {
  const Axes axes(axis);
  const double m = subject.m();
  return [=](Double3 w) { return power_law_pdf(m, axes.local(w)); };
}

}  // namespace

TEST_CASE("Lab 7.6: the mirror direction leaves on the other side at the same angle",
          "[lab07][ex6]") {
  const std::vector<Vec3> all = hard_normals();
  const Rows rows =
      probe("Lab 7.6 mirror", {}, {.rows = all.size(), .columns = 3, .finite = false});
  const std::vector<Double3> mirrors = directions_in(rows);
  std::vector<Diagnosis> diagnoses;
  double worst = 0, as_wo = 0, below = 0, opposite = 0;
  const auto raise = [](double& most, double value) { most = value <= most ? most : value; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Double3 wo(all[i].x, all[i].y, std::abs(all[i].z));
    raise(worst, glm::length(mirrors[i] - Double3(-wo.x, -wo.y, wo.z)));
    raise(as_wo, glm::length(mirrors[i] - wo));
    raise(below, glm::length(mirrors[i] - Double3(wo.x, wo.y, -wo.z)));
    raise(opposite, glm::length(mirrors[i] + wo));
  }
  if (as_wo < 1e-6) diagnoses.push_back(about_wo);
  if (below < 1e-6 || opposite < 1e-6) diagnoses.push_back(below_surface);
  judge(holds("the mirror direction", worst <= 1e-6, fmt::format("off by up to {:.2g}", worst),
              "right within 1e-6", diagnoses));
}

TEST_CASE("Lab 7.6: directions follow the lobe about the mirror direction, at grazing angles too",
          "[lab07][ex6]") {
  for (const Subject& subject :
       {mirror_subject(5, 0), mirror_subject(1, 60), mirror_subject(10, 80),
        mirror_subject(1000, 89), mirror_subject(1e7, 89.9)}) {
    const Drawn drawn = draw(subject, n_directions);
    judge_drawn(subject, drawn);
    Verdict verdict = samples_follow(subject, drawn.directions);
    if (!verdict.passed) name_axis(verdict, subject, drawn.directions);
    judge(verdict);
  }
}

TEST_CASE("Lab 7.6: as much of the lobe lies below the horizon as theory says", "[lab07][ex6]") {
  for (const auto& [n, degrees] : {std::pair{1, 60.0}, {10, 80.0}, {1000, 89.0}}) {
    const Subject subject = mirror_subject(n, degrees);
    std::vector<double> below, cosines;
    const double p = below_horizon(n, degrees * pi / 180);
    for (const Double3 w : draw(subject, n_directions).directions)
      below.push_back(w.z < 0 ? 1 : 0);
    judge(mean_is(fmt::format("the part below the horizon, {}", subject.name), below,
                  {p, std::sqrt(p * (1 - p))}, {{0, below_changed}, {1 - p, below_surface}}));
  }
}

TEST_CASE("Lab 7.6: the mean cosine above the horizon is the albedo's", "[lab07][ex6]") {
  for (const auto& [n, degrees] : {std::pair{1, 60.0}, {2, 80.0}, {50, 89.0}}) {
    const Subject subject = mirror_subject(n, degrees);
    std::vector<double> cosines;
    for (const Double3 w : draw(subject, n_directions).directions)
      cosines.push_back(std::max(0.0, w.z));
    const double mean = (n + 1.0) / (n + 2.0) * lobe_albedo(n, degrees * pi / 180);
    // The mean of the squared cosine above the horizon, by the midpoint rule in the lobe's shares.
    double square = 0;
    constexpr int steps = 600;
    for (int i = 0; i < steps; ++i) {
      const double cosine = std::pow(1 - (i + 0.5) / steps, 1 / (n + 1.0));
      const double sine = std::sqrt(1 - cosine * cosine);
      for (int k = 0; k < steps; ++k) {
        const double phi = 2 * pi * (k + 0.5) / steps;
        const double z =
            subject.axes().world({sine * std::cos(phi), sine * std::sin(phi), cosine}).z;
        if (z > 0) square += z * z / (1.0 * steps * steps);
      }
    }
    const double p = below_horizon(n, degrees * pi / 180);
    judge(mean_is(fmt::format("the mean of max(0, cos(theta)), {}", subject.name), cosines,
                  {mean, std::sqrt(square - mean * mean)}, {{mean / (1 - p), below_changed}}));
  }
}

TEST_CASE("Lab 7.6: every u gives a direction with a density above 0", "[lab07][ex6]") {
  for (const Subject& subject : {mirror_subject(1, 45), mirror_subject(10, 89.9),
                                 mirror_subject(1e4, 60), mirror_subject(1e7, 80)}) {
    judge_edges(subject, {});
  }
}

TEST_CASE("Lab 7.6: the density integrates to 1 over the whole sphere", "[lab07][ex6]") {
  for (const auto& [n, degrees] : {std::pair{1, 60.0}, {5, 80.0}, {10, 30.0}}) {
    const Subject subject = mirror_subject(n, degrees);
    const Double3 wo(subject.wo);
    const double p = below_horizon(n, degrees * pi / 180);
    const auto exact = [=](Double3 w) { return subject.pdf(w); };
    const auto cut = [=](Double3 w) { return w.z < 0 ? 0 : exact(w); };
    const auto brdf = [=, n = n](Double3 w) { return exact(w) * (n + 2) / (n + 1); };
    std::vector<OtherPdf> others;
    others.push_back({pdf_about(subject, wo), about_wo});
    others.push_back({pdf_about(subject, {0, 0, 1}), about_surface_normal});
    others.push_back({pdf_about(subject, -wo), below_surface});
    others.push_back({cut, cut_density});
    others.push_back({brdf, n_plus_2});
    judge_density(subject, others, {{1 - p, cut_density}, {(n + 2.0) / (n + 1.0), n_plus_2}});
  }
  // The analyser loses track of what a std::function owns.
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks)

TEST_CASE("Lab 7.6: the density is right across the narrowest lobes, at grazing angles too",
          "[lab07][ex6]") {
  for (const Subject& subject :
       {mirror_subject(1000, 60), mirror_subject(1e6, 45), mirror_subject(1e7, 89.9)}) {
    const Rows rows = probe("Lab 7.5 to 7.6 lobe density", subject.params(),
                            {.rows = lobe_steps, .finite = false, .of = subject.name});
    std::vector<Double3> places;
    for (int step = 0; step < lobe_steps; ++step)
      places.emplace_back(
          lobe_direction(step, subject.n, {-subject.wo.x, -subject.wo.y, subject.wo.z}));
    judge(narrow_density_is(subject, places, rows.values));
  }
}
