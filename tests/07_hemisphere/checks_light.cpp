// Checks of exercise 7.7. Irradiance against closed forms: 320 000 directions per scene; the z test
// uses the exact variance of L cos/p, by quadrature. The largest cv of one direction is 3.6 (the
// wall, by uniform directions): a bias of 5.6 % is detected with power .999, .9 % for the sky. The
// variance is tested separately, since it shows whether the requested technique was used.

#include "07_hemisphere/irradiance.h"
#include "grader/protocol/next_words.h"

#include <cmath>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

const Diagnosis missing_cosine{"missing-cosine",
                               "the integral of L is given, not of L cos(theta)."};
const Diagnosis missing_pdf{
    "missing-one-over-pdf",
    "the mean of L cos(theta) is not divided by the density of the directions."};
const Diagnosis cosine_twice{
    "cosine-counted-twice",
    "the density of cosine-weighted directions already includes the cosine: the two cancel."};
const Diagnosis not_counted{
    "below-horizon-not-counted",
    "directions below the horizon are left out of the count; they contribute "
    "0, but they were drawn."};
const Diagnosis absolute_cosine{
    "below-horizon-kept", "directions below the horizon contribute; no light comes from there."};
const Diagnosis asks_below{"radiance-asked-below-horizon",
                           "radiance() is called for directions below the horizon."};
const Diagnosis missing_pi{"missing-one-over-pi",
                           "ambient occlusion is 1 under an open sky, whose irradiance is pi."};
const Diagnosis by_two_pi{"one-over-two-pi",
                          "the cosine integrates to pi over the hemisphere, not to 2 pi."};
const Diagnosis other_technique{
    "technique-not-used", "the variance is that of another technique than the requested one."};
const Diagnosis reused{"reused-number", "fewer than two numbers are drawn for a direction."};
const Diagnosis local_not_world{"local-direction-not-turned",
                                "directions have to be transformed from the local frame to the "
                                "world before radiance() is called."};
const Diagnosis radiance_not_used{
    "radiance-not-used",
    "this is as if the same light came from everywhere: multiply each direction's contribution "
    "by the radiance from there."};
const Diagnosis visible_not_used{
    "visible-not-used",
    "this is as if the whole sky were visible: a blocked direction contributes nothing."};
const Diagnosis density_zero{
    "divided-by-density-zero",
    "a direction of the lobe whose density is 0 is divided by it: rotating a direction at the "
    "lobe's outermost edge may round it out of the lobe. Its weight is 0."};
const Diagnosis float_sum{"sum-in-float",
                          "the sum is a float: once it is large, every summand is rounded to the "
                          "spacing of floats there. Keep the sum in double."};
const Diagnosis only_the_lobe{
    "only-the-lobe-fails",
    "the other techniques are right under the same light, the lobe is not: is wo transformed "
    "into the frame in which the lobe is drawn, does the lobe surround the mirror direction of "
    "wo, and is its density that of Lab 7.6 for the same wo?"};

constexpr Vec3 tilted{0.48f, -0.6f, -0.64f};

Params params_of(const Case& c, Vec3 normal, double n, bool ambient = false) {
  return {.n = static_cast<std::int64_t>(n),
          .numbers = {{"x", normal.x},
                      {"y", normal.y},
                      {"z", normal.z},
                      {"light", static_cast<double>(c.light)},
                      {"technique", static_cast<double>(c.technique)},
                      {"exponent", c.n},
                      {"aim", c.aimed ? 1 : 0},
                      {"ambient", ambient ? 1 : 0},
                      {"repetitions", repetitions}}};
}

std::vector<double> estimates(const Case& c, Vec3 normal, bool ambient = false) {
  return probe("Lab 7.7 estimates", params_of(c, normal, count, ambient),
               {.rows = static_cast<std::size_t>(repetitions),
                .of = fmt::format("{} directions, {}", count, c.name)})
      .values;
}

Suspects suspects_of(const Case& c, Vec3 normal, double scale) {
  const double mean = scale * exact_irradiance(c.light);
  const auto add_up = [&](const auto& f) { return scale * lit_integral(c, f); };
  Suspects suspects{{add_up([](Double3) { return 1.0; }), missing_cosine},
                    {add_up([&](Double3 w) { return w.z * pdf_of(c, w); }), missing_pdf}};
  if (c.light != Light::sky) {
    suspects.push_back({scale * open_sky(c), scale == 1 ? radiance_not_used : visible_not_used});
  }
  if (c.technique == Technique::cosine) {
    suspects.push_back({add_up([](Double3 w) { return w.z * w.z; }), cosine_twice});
  }
  if (const double lost = lost_part(c); lost > 0.01) {
    const double below = scale * lit_integral(
                                     c, [](Double3 w) { return w.z; }, true);
    suspects.push_back({mean / (1 - lost), not_counted});
    suspects.push_back({mean - below, absolute_cosine});
    suspects.push_back({mean + below, absolute_cosine});
  }
  const Axes axes(normal);
  double unturned = 0;
  over_directions({0, 0, 1}, 1, [&](Double3 w, double solid_angle) {
    if (lit(c.light, axes.local(w))) unturned += w.z * solid_angle;
  });
  suspects.push_back({scale * unturned, local_not_world});
  return suspects;
}

/// True if the techniques without a lobe are right under the same light.
bool others_are_right(const Case& c, Vec3 normal) {
  for (const Technique technique : {Technique::uniform, Technique::cosine}) {
    // Nearly all of their directions miss a tiny sun, so it is no test.
    const Case other = make(c.light == Light::sun ? Light::ball : c.light, technique);
    if (!mean_is("", estimates(other, normal), theory_of(other)).passed) return false;
  }
  return true;
}

/// Judges the mean against theory. Possible mistakes are computed only if it is wrong.
Verdict mean_verdict(const std::string& what, const Case& c, Vec3 normal,
                     const std::vector<double>& values, double scale = 1) {
  const Theory theory = theory_of(c, scale);
  Verdict verdict = mean_is(what, values, theory);
  if (verdict.passed) return verdict;
  const Suspects suspects = suspects_of(c, normal, scale);
  if (c.technique != Technique::lobe || !others_are_right(c, normal)) {
    return mean_is(what, values, theory, suspects);
  }
  // A mistake in the lobe can give any value: report others only if they fit closely.
  double mean = 0;
  for (const double value : values)
    mean += value / static_cast<double>(values.size());
  Verdict lobe = verdict;
  lobe.diagnoses = {};
  for (const auto& [value, diagnosis] : suspects) {
    const bool fits = std::abs(mean - value) <= 0.01 * std::abs(value);
    if (fits && diagnosis.id != local_not_world.id) lobe.diagnoses.push_back(diagnosis);
  }
  if (lobe.diagnoses.empty()) lobe.diagnoses = {only_the_lobe};
  return lobe;
}

/// Judges ambient occlusion. If the irradiance by the same lobe is right, so is the lobe.
Verdict occlusion_verdict(const std::string& what, const Case& c,
                          const std::vector<double>& values) {
  if (!mean_is("", estimates(c, tilted), theory_of(c)).passed)
    return mean_verdict(what, c, tilted, values, 1 / pi);
  const double mean = exact_irradiance(c.light) / pi;
  Suspects suspects = suspects_of(c, tilted, 1 / pi);
  suspects.push_back({mean * pi, missing_pi});
  suspects.push_back({mean / 2, by_two_pi});
  suspects.push_back({lit_integral(c, [](Double3) { return 1 / (2 * pi); }), missing_cosine});
  return mean_is(what, values, theory_of(c, 1 / pi), suspects);
}

void judge_mean(const Case& c, Vec3 normal) {
  const std::string around = fmt::format("({:g}, {:g}, {:g})", normal.x, normal.y, normal.z);
  judge(mean_verdict(fmt::format("the irradiance under {}, normal {}", c.name, around), c, normal,
                     estimates(c, normal)));
}

void judge_variance(const Case& c) {
  Suspects suspects;
  for (const Technique other : {Technique::uniform, Technique::cosine}) {
    const double sd = theory_of(make(c.light, other)).sd;
    if (other != c.technique) suspects.push_back({sd * sd, other_technique});
  }
  judge(variance_is("the variance of estimates under " + c.name, estimates(c, tilted), theory_of(c),
                    suspects));
}

/// Checks that all estimates equal a constant: the technique's density is proportional to the
/// integrand.
void judge_exact(const Case& c) {
  double worst = 0;
  for (const double value : estimates(c, tilted))
    worst = std::abs(value - pi) <= worst ? worst : std::abs(value - pi);
  judge(holds("each estimate under " + c.name, worst <= 1e-4,
              fmt::format("off pi by up to {:.2g}", worst),
              "pi: the density is proportional to what is integrated, the variance is 0",
              {c.technique == Technique::lobe ? only_the_lobe : other_technique}));
}

}  // namespace

TEST_CASE("Lab 7.7: irradiance is unbiased for a ball, a disk and a wall, by every technique",
          "[lab07][ex7]") {
  for (const Light light : {Light::ball, Light::disk, Light::wall}) {
    for (const Technique technique :
         {Technique::rejection, Technique::uniform, Technique::cosine}) {
      const Case c = make(light, technique);
      judge_mean(c, tilted);
    }
  }
}

TEST_CASE("Lab 7.7: the lobe may point at the light, and partly below the horizon",
          "[lab07][ex7]") {
  for (const Case& c :
       {make(Light::sky, Technique::lobe, 0.5), make(Light::ball, Technique::lobe, 4, true),
        make(Light::sunset, Technique::lobe, 4, true),
        make(Light::sun, Technique::lobe, 1e7, true)}) {
    for (const Vec3 normal : {tilted, Vec3(0, 0, 1)})
      judge_mean(c, normal);
  }
}

TEST_CASE("Lab 7.7: each technique has its own variance", "[lab07][ex7][variance]") {
  for (const Case& c :
       {make(Light::sky, Technique::rejection), make(Light::sky, Technique::uniform),
        make(Light::ball, Technique::cosine), make(Light::ball, Technique::lobe, 4, true)}) {
    judge_variance(c);
  }
}

TEST_CASE("Lab 7.7: where the density is proportional to the cosine, an open sky has no variance",
          "[lab07][ex7]") {
  judge_exact(make(Light::sky, Technique::cosine));
  judge_exact(make(Light::sky, Technique::lobe, 1));
}

TEST_CASE("Lab 7.7: ambient occlusion is irradiance over pi", "[lab07][ex7]") {
  for (const Case& c : {make(Light::disk, Technique::uniform), make(Light::disk, Technique::cosine),
                        make(Light::ball, Technique::lobe, 4, true)}) {
    const std::string what = "the ambient occlusion under " + c.name;
    const std::vector<double> values = estimates(c, tilted, true);
    Verdict verdict = mean_is(what, values, theory_of(c, 1 / pi));
    if (!verdict.passed) verdict = occlusion_verdict(what, c, values);
    judge(verdict);
  }
}

TEST_CASE("Lab 7.7: radiance is asked once a direction, and never below the horizon",
          "[lab07][ex7]") {
  constexpr std::int64_t n = 20'000;
  for (const Case& c : {make(Light::sky, Technique::uniform), make(Light::sky, Technique::cosine),
                        make(Light::sunset, Technique::lobe, 4, true)}) {
    const Answer rows =
        probe("Lab 7.7 record", params_of(c, tilted, n), {.columns = 7, .of = c.name});
    const double asked = rows.at(0, 0), below = rows.at(0, 1), off = rows.at(0, 2);
    const NextWords next{rows.at(0, 3), rows.at(0, 4), rows.at(0, 5), rows.at(0, 6)};
    const double words = words_drawn(carlo::Rng(rows.seed), next, 64 * n);
    judge(holds("radiance asked for below the horizon, under " + c.name, below == 0,
                fmt::format("{} times", below), "never",
                {c.technique == Technique::lobe ? asks_below : local_not_world}));
    judge(holds("the length of the directions asked for, under " + c.name, off <= 1e-5,
                fmt::format("off 1 by {:.2g}", off), "1"));
    // The lobe loses the part below the horizon, within 8 standard deviations. A direction at the
    // horizon may be rounded below it.
    const double lost = lost_part(c);
    const double tolerance = lost > 0 ? 8 * std::sqrt(n * lost * (1 - lost)) : 2;
    judge(equals("how often radiance was asked for, under " + c.name, asked, n * (1 - lost),
                 tolerance));
    judge(equals("numbers drawn, under " + c.name, words, 2 * n, 0, {{n, reused}}));
  }
}

// At most 2 pi cos(theta) for n = 0; at n = 0.05 the density is above 0.07 for every float.
TEST_CASE("Lab 7.7: a direction on the lobe's very edge does not spoil the estimate",
          "[lab07][ex7]") {
  for (const double n : {0.0, 0.05}) {
    const std::string lobe = fmt::format("the lobe of n = {:g}", n);
    const Params params = {
        .numbers = {{"exponent", n}, {"x", tilted.x}, {"y", tilted.y}, {"z", tilted.z}}};
    const Rows rows =
        probe("Lab 7.7 edge", params,
              {.rows = std::size_t{edge_streams} * edge_mirrors, .finite = false, .of = lobe});
    const auto wrong = std::count_if(rows.values.begin(), rows.values.end(),
                                     [](double e) { return !(e >= 0 && e <= 20); });
    judge(holds(
        fmt::format("estimates from one direction of {} whose u.x is the last float below 1", lobe),
        wrong == 0, fmt::format("{} of {} are infinite or no number", wrong, rows.values.size()),
        "at most cos(theta)/pdf, or 0", {density_zero}));
  }
}

// Floats are 1/4 apart where the sum ends.
TEST_CASE("Lab 7.7: the sum is kept in double", "[lab07][ex7]") {
  constexpr int many = 1 << 20;
  const Rows rows = probe("Lab 7.7 many", {.n = many}, {.finite = false});
  float in_float = 0;
  for (int i = 0; i < many; ++i)
    in_float += std::numbers::pi_v<float>;
  judge(equals(
      fmt::format("the irradiance under an open sky from {} cosine-weighted directions", many),
      rows.values[0], pi, 1e-4, {{static_cast<double>(in_float) / many, float_sum}}));
}
