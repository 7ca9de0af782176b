// Checks of exercises 7.3 to 7.5. Directions: chi-square over 16 x 16 cells of equal mass, in the
// angle and the azimuth together, from 200 000 directions; cells off by 3.7 % each (rms) are
// detected with power .999. Where the lobe is narrow, a Kolmogorov-Smirnov test of 1 - cos^(n+1),
// which is uniform, in double: a distribution function that is off by .015 is detected. Densities
// are compared with their closed forms all over the sphere, and integrated.

#include "07_hemisphere/subject.h"

#include <set>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

const Diagnosis theta_uniform{
    "uniform-angle",
    "theta itself is uniform: directions crowd around the normal, where a "
    "ring of the same width has less area."};
const Diagnosis cosine_instead{"cosine-weighted-instead", "the directions are cosine-weighted."};
const Diagnosis whole_sphere{"whole-sphere",
                             "1/(4 pi) is the density of the whole sphere; the hemisphere has half "
                             "its solid angle."};
const Diagnosis not_zero_below{"density-below-horizon",
                               "there are no samples below the horizon: the density is 0 there."};
const Diagnosis cosine_missing_pi{"missing-one-over-pi",
                                  "the cosine integrates to pi over the hemisphere: divide by it."};
const Diagnosis cosine_by_two_pi{
    "one-over-two-pi", "1/(2 pi) normalises the uniform density; the cosine integrates to pi."};
const Diagnosis root_missing{
    "square-root-missing",
    "these directions are uniform: the inverse of the CDF has a square root."};
const Diagnosis uniform_radius{
    "uniform-radius",
    "sin(theta) is uniform: the points below the directions crowd at the "
    "disc's centre."};
const Diagnosis zero_cosine{"zero-cosine",
                            "a number u = 0 gives a direction on the horizon, whose density is 0; "
                            "use 1 - u, which is never 0."};
const Diagnosis zero_leaves{
    "zero-leaves-the-lobe",
    "the number u = 0 gives a direction at 90 degrees to the axis, where the "
    "density is 0: log(0). Use 1 - u, which is never 0."};
const Diagnosis root_n{
    "root-of-order-n",
    "the CDF of the angle is 1 - cos^(n+1): the root is the (n+1)-th, not the n-th."};
const Diagnosis root_n_plus_2{
    "root-of-order-n-plus-2",
    "n + 2 belongs to the integral with an additional cosine; per solid angle the CDF is 1 - "
    "cos^(n+1)."};
const Diagnosis few_angles{
    "sine-by-subtraction",
    "only a few different angles occur: 1 - cos^2 loses all digits if the cosine rounds to 1. "
    "expm1 keeps them."};
const Diagnosis lobe_n_plus_2{
    "n-plus-two",
    "(n + 2)/(2 pi) normalises the lobe times a cosine, as in the BRDF; per solid "
    "angle it is n + 1."};
const Diagnosis only_n{"n-for-n-plus-one", "the lobe integrates to 2 pi/(n + 1), not 2 pi/n."};
const Diagnosis lobe_not_normalised{
    "lobe-not-normalised", "cos^n alone does not integrate to 1: multiply by (n + 1)/(2 pi)."};
const Diagnosis back_counts{"back-of-the-lobe",
                            "beyond 90 degrees the lobe is 0; there cos^n is a power of a negative "
                            "number."};
constexpr std::size_t n_sampled = 200'000;

double upper(double value, Double3 w) {
  return w.z > 0 ? value : 0;
}

/// True if the density is 0 wherever theory's is 0; otherwise it may be one of the others'.
bool wrong_only_below(const Subject& subject) {
  const Rows rows = probe(
      "Lab 7.3 to 7.6 density", subject.params(),
      {.rows = std::size_t{density_rings} * density_sectors, .finite = false, .of = subject.name});
  for (int ring = 0; ring < density_rings / 2; ++ring) {
    const Double3 w = density_place(ring, 0);
    const double value = rows.values[static_cast<std::size_t>(ring) * density_sectors];
    if (!agree(value, subject.pdf(w), 2 * subject.tolerance(w))) return false;
  }
  return rows.values.back() != 0;
}

void judge_zero_below(const Subject& subject, const Diagnosis& diagnosis) {
  judge(is_so("the density below the horizon", !wrong_only_below(subject), "is not 0", "0",
              {diagnosis}));
}

/// 1 - cos^(n+1) in double, from the directions' x and y.
Verdict lobe_angles(const Subject& subject, const std::vector<Double3>& directions) {
  std::vector<double> shares;
  for (const Double3 w : local_to(subject.axes(), directions))
    shares.push_back(power_law(subject.m())(w));
  Verdict verdict = uniform_on("1 - cos^(n+1) of " + subject.name, shares, 0, 1);
  if (verdict.passed) return verdict;
  // To seven digits, since phi is rounded as well.
  std::set<float> angles;
  for (const double share : shares)
    angles.insert(static_cast<float>(share));
  if (angles.size() < directions.size() / 20) verdict.diagnoses.push_back(few_angles);
  return verdict;
}

}  // namespace

TEST_CASE("Lab 7.3: directions are uniform, of length 1 and above the horizon", "[lab07][ex3]") {
  const Subject subject = uniform_subject();
  const Drawn drawn = draw(subject, n_sampled);
  judge_drawn(subject, drawn);
  judge(samples_follow(subject, drawn.directions,
                       {{uniform_angle, theta_uniform}, {power_law(2), cosine_instead}}));
}

TEST_CASE("Lab 7.3: the density is that of the hemisphere, and 0 below", "[lab07][ex3]") {
  const Subject subject = uniform_subject();
  judge_density(subject,
                {{[](Double3) { return 1 / (4 * pi); }, whole_sphere},
                 {[](Double3 w) { return upper(1 / (4 * pi), w); }, whole_sphere},
                 {[](Double3) { return 1 / (2 * pi); }, not_zero_below}},
                {{0.5, whole_sphere}, {2, not_zero_below}});
}

TEST_CASE("Lab 7.3: every u gives a direction above the horizon", "[lab07][ex3]") {
  judge_edges(uniform_subject(), {zero_cosine});
}

TEST_CASE("Lab 7.3: nearby u give nearby directions", "[lab07][ex3]") {
  judge_neighbours(uniform_subject());
}

TEST_CASE("Lab 7.4: directions are cosine-weighted, of length 1 and above the horizon",
          "[lab07][ex4]") {
  const Subject subject = cosine_subject();
  const Drawn drawn = draw(subject, n_sampled);
  judge_drawn(subject, drawn);
  judge(samples_follow(subject, drawn.directions,
                       {{power_law(1), root_missing},
                        {uniform_angle, theta_uniform},
                        {uniform_sine, uniform_radius}}));
}

TEST_CASE("Lab 7.4: the density is the cosine over pi, and 0 below", "[lab07][ex4]") {
  const Subject subject = cosine_subject();
  judge_density(
      subject,
      {{[](Double3 w) { return upper(w.z, w); }, cosine_missing_pi},
       {[](Double3 w) { return upper(w.z / (2 * pi), w); }, cosine_by_two_pi},
       {[](Double3 w) { return std::abs(w.z) / pi; }, not_zero_below},
       {[](Double3 w) { return w.z / pi; }, not_zero_below}},
      {{pi, cosine_missing_pi}, {0.5, cosine_by_two_pi}, {2, not_zero_below}, {0, not_zero_below}});
}

TEST_CASE("Lab 7.4: every u gives a direction with a density above 0", "[lab07][ex4]") {
  judge_edges(cosine_subject(), {zero_cosine});
}

TEST_CASE("Lab 7.4: nearby u give nearby directions", "[lab07][ex4]") {
  judge_neighbours(cosine_subject());
}

TEST_CASE("Lab 7.5: directions follow the lobe, in angle and azimuth", "[lab07][ex5]") {
  for (const double n : {0.0, 1.0, 2.5, 20.0, 1000.0, 1e7}) {
    const Subject subject = lobe_subject(n);
    const Drawn drawn = draw(subject, n_sampled);
    // The 0th root is undefined: all directions end up on the horizon.
    judge_drawn(subject, drawn, n == 0 ? std::vector{root_n} : std::vector<Diagnosis>{});
    std::vector<OtherLaw> others = {{power_law(n + 2), root_n_plus_2},
                                    {uniform_angle, theta_uniform}};
    if (n > 0) others.push_back({power_law(n), root_n});
    judge(samples_follow(subject, drawn.directions, others));
  }
}

TEST_CASE("Lab 7.5: nearby u give nearby directions", "[lab07][ex5]") {
  for (const double n : {0.0, 2.5, 1e4})
    judge_neighbours(lobe_subject(n));
}

TEST_CASE("Lab 7.5: the angle's law holds in double, to n = 1e7", "[lab07][ex5]") {
  for (const double n : {1e6, 1e7}) {
    const Subject subject = lobe_subject(n);
    judge(lobe_angles(subject, draw(subject, n_sampled).directions));
  }
}

TEST_CASE("Lab 7.5: every u gives a direction within the lobe", "[lab07][ex5]") {
  for (const double n : {0.0, 1.0, 50.0, 1e4, 1e7})
    judge_edges(lobe_subject(n), {zero_leaves});
}

TEST_CASE("Lab 7.5: the density integrates to 1 and is 0 outside the lobe", "[lab07][ex5]") {
  for (const double n : {0.0, 1.0, 2.5, 5.0, 10.0}) {
    const Subject subject = lobe_subject(n);
    const double right = (n + 1) / (2 * pi);
    const auto scaled = [=](double factor) {
      return [=](Double3 w) { return upper(factor / right * power_law_pdf(n + 1, w), w); };
    };
    judge_zero_below(subject, back_counts);
    judge_density(subject,
                  {{scaled((n + 2) / (2 * pi)), lobe_n_plus_2},
                   {scaled(n / (2 * pi)), only_n},
                   {scaled(1), lobe_not_normalised}},
                  {{(n + 2) / (n + 1), lobe_n_plus_2}, {n / (n + 1), only_n}});
  }
}

TEST_CASE("Lab 7.5: the density is right across the narrowest lobes", "[lab07][ex5]") {
  for (const double n : {20.0, 1000.0, 1e5, 1e6, 1e7}) {
    const Subject subject = lobe_subject(n);
    const Rows rows = probe("Lab 7.5 to 7.6 lobe density", subject.params(),
                            {.rows = lobe_steps, .finite = false, .of = subject.name});
    std::vector<Double3> places;
    for (int step = 0; step < lobe_steps; ++step) {
      places.emplace_back(lobe_direction(step, n, {0, 0, 1}));
    }
    judge(narrow_density_is(subject, places, rows.values));
  }
}
