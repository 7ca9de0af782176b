// Checks of exercises 8.4, 8.6 and 8.8: worlds with closed forms, 50 000 paths each.
// The lecture's rule in a furnace of albedo 1/2 has infinite variance (the value is multiplied by
// 10 with probability 1/20 each time), and no z test of its mean means anything: its values are
// known one by one instead, and how often each must come.

#include "08_path_tracer/theory.h"
#include "08_path_tracer/views.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis emission_not_divided{"emission-not-divided",
                                     "emission was chosen with probability p_emit: divide by it."};
const Diagnosis reflection_not_divided{"reflection-not-divided",
                                       "reflection was chosen with probability 1 - p_emit: divide "
                                       "by it."};
const Diagnosis mended_already{"lecture-rule-mended",
                               "emission and reflection are added: word for word, the lecture's "
                               "rule returns one of the two."};
const Diagnosis chances_swapped{"emission-and-reflection-swapped",
                                "emission is chosen with probability 1 - p_emit, and reflection "
                                "with p_emit: it should be the other way about."};
const Diagnosis still_the_lecture{"still-the-lectures-rule",
                                  "this is the lecture's rule still: emission is to be added, "
                                  "always, and divided by nothing."};
const Diagnosis into_the_lecture{"recursion-into-the-lectures-rule",
                                 "the first surface is right; from the second on it is the "
                                 "lecture's rule: trace_path() has to call itself."};
const Diagnosis no_weight{"weight-missing",
                          "what arrives along sample()'s direction is multiplied by its weight."};
const Diagnosis no_emission{"emission-missing", "what the surfaces emit is missing."};
const Diagnosis one_bounce{"emission-of-first-surface-only",
                           "only what the first surface emits arrives."};
const Diagnosis counted_twice{
    "emission-counted-twice",
    "light that direct_by_area() has brought is counted again where a ray "
    "meets the light."};
const Diagnosis direct_missing{"direct-light-missing",
                               "light straight from the lights is missing."};
const Diagnosis self_hit{"ray-meets-its-own-surface",
                         "light gets lost: a ray that starts on a surface meets that again; "
                         "world.leave() starts it beside."};
const Diagnosis sky_missing{"environment-missing",
                            "rays that meet no surface bring world.environment()."};
const Diagnosis no_compensation{"roulette-without-compensation",
                                "paths end by roulette and those that go on carry no more: divide "
                                "by the probability to survive."};
const Diagnosis both_whole{"techniques-not-weighted",
                           "both techniques bring all of the direct light: their weights have to "
                           "add up to 1."};
const Diagnosis kept_across{
    "vertex-kept-across-mirror",
    "after a mirror or glass emission counts whole: no point of a light was sampled there. The "
    "surface before and its density have nothing to do with it: forget them."};
const Diagnosis read_twice{"random-number-reused",
                           "one number served two decisions: seek() to the vertex's own places."};
const Diagnosis depth_slips{"depth-off-by-one",
                            "a path of max_depth = 1 sees emission only, of 2 direct light."};
const Diagnosis sums_not_squares{"balance-heuristic",
                                 "this is the balance heuristic: the power heuristic squares."};
const Diagnosis squares_overflow{
    "squares-overflow",
    "p^2 and q^2 overflow, or vanish, where p and q are large or small: "
    "square their ratio."};
const Diagnosis light_choice{"light-choice-not-in-pdf",
                             "one of several lights is chosen: the density is divided among them."};
const Diagnosis no_cosine{"cosine-missing-in-light-pdf",
                          "distance^2/(cos area): the cosine at the light is missing."};
const Diagnosis no_distance_in_pdf{"distance-missing-in-light-pdf",
                                   "distance^2/(cos area): the squared distance is missing."};

constexpr std::size_t paths = 50'000;

enum Method { lecture = 0, mended = 1, direct = 2 };

Params with(Place place, std::map<std::string, double> numbers) {
  numbers.insert({{"place", static_cast<double>(place)}, {"degrees", 0}, {"emission", 1}});
  return {.n = paths, .numbers = std::move(numbers)};
}

Rows trace(Method method, Params params) {
  params.numbers["method"] = static_cast<double>(method);
  const char* const rules[] = {"the lecture's rule, ", "mended, ", ""};
  return probe(
      "Lab 8 paths", params,
      {.rows = paths, .columns = 3, .of = fmt::format("{}{}", rules[method], view_text(params))});
}

Rows trace_all(Params params, double depth, bool finite = true) {
  params.numbers["depth"] = depth;
  const std::string length = depth == 0 ? "any length" : fmt::format("max_depth = {}", depth);
  return probe("Lab 8.8 paths", params,
               {.rows = paths,
                .columns = 6,
                .finite = finite,
                .of = fmt::format("{}, {}", length, view_text(params))});
}

Params furnace_of(double r, double g) {
  return with(in_furnace, {{"r", r}, {"g", g}, {"b", r}});
}

const PhongCase glossy{0.3f, 0.6f, 50};
constexpr double slant = 60;

Params ball_of(const PhongCase& c) {
  return with(on_ball, {{"kd", static_cast<double>(c.kd)},
                        {"ks", static_cast<double>(c.ks)},
                        {"exponent", static_cast<double>(c.n)},
                        {"degrees", slant}});
}

/// Radiance of the glossy ball under a sky of 1.
Theory ball_theory() {
  const Moments m = PhongTheory(glossy).weights(slant);
  return {
      static_cast<double>(glossy.kd) + static_cast<double>(glossy.ks) * specular_albedo(50, slant),
      m.sd()};
}

/// Emission 1 at every vertex of a path that goes on with probability `go` and weight `weight`:
/// mean and sd of 1 + weight + weight^2 + ...
Theory series(double go, double weight) {
  const double mean = 1 / (1 - go * weight);
  const double square = (1 + 2 * go * weight * mean) / (1 - go * weight * weight);
  return {mean, std::sqrt(square - mean * mean)};
}

const double lamp_share =
    0.7522747 / pi;  ///< of cosine-weighted directions that meet the square lamp

}  // namespace

TEST_CASE("Lab 8.4: p_emit is 0, 1 or 0.9", "[lab08][ex4]") {
  const Rows rows = probe("Lab 8.4 p_emit", {}, {.rows = 6});
  judge(
      all_equal("p_emit of a surface that reflects; emits; does both; in different channels; "
                "neither; emits and is glossy",
                rows.values, std::vector{0.0, 1.0, 0.9, 0.9, 0.0, 0.9}, 1e-6));
}

namespace {

/// The lecture's p_emit.
constexpr double p = 0.9;

/// Whether more than 10 of the values are this one.
bool has(const std::vector<double>& values, double value) {
  return std::count_if(values.begin(), values.end(),
                       [&](double v) { return std::abs(v - value) < 1e-3 * value; }) > 10;
}

/// In a furnace: emission came with the chance, or the division, of reflection.
bool swapped(const std::vector<double>& values) {
  const auto first = std::count_if(values.begin(), values.end(),
                                   [](double v) { return std::abs(v * p - 1) < 1e-3; });
  const double share = static_cast<double>(first) / static_cast<double>(values.size());
  return first == 0 ? has(values, 1 / (1 - p)) && !has(values, 1)
                    : std::abs(share - (1 - p)) < 0.01;
}

/// Whether about half of the rays get lost from the second bounce on, as those do that start on a
/// surface: there a furnace whose albedo is q rho shows 1/(1 - q rho). The first bounce is the same
/// one for all paths.
bool loses_half(const Rows& rows) {
  double red = 0, green = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    red += rows.at(i, 0) / static_cast<double>(rows.count());
    green += rows.at(i, 1) / static_cast<double>(rows.count());
  }
  const auto share = [](double mean, double rho) { return (1 - rho / (mean - 1)) / rho; };
  const auto half = [](double q) { return q > 0.3 && q < 0.7; };
  return half(share(red, 0.5)) && half(share(green, 0.25));
}

}  // namespace

TEST_CASE("Lab 8.4: the lecture's rule gives each value as often as it must", "[lab08][ex4]") {
  constexpr double rho = 0.5;
  const std::vector<double> values = column(trace(lecture, furnace_of(rho, rho)), 0);
  std::vector<double> none, first, second;
  double strange = 0;
  for (const double v : values) {
    const double steps = v > 0 ? std::log10(v * p) : 0;
    strange += std::abs(steps - std::round(steps)) <= 1e-4 && steps > -0.5 ? 0 : 1;
    none.push_back(v == 0 ? 1 : 0);
    first.push_back(v > 0 && std::abs(v * p - 1) < 1e-3 ? 1 : 0);
    second.push_back(std::abs(v * p - 10) < 1e-2 ? 1 : 0);
  }
  const auto bernoulli = [](double q) { return Theory{q, std::sqrt(q * (1 - q))}; };
  std::vector<Diagnosis> diagnoses;
  Suspects without_tens;
  if (has(values, 1) && has(values, 2)) {
    diagnoses.push_back(mended_already);
  } else if (has(values, 1)) {
    diagnoses.push_back(emission_not_divided);
  } else if (swapped(values)) {
    diagnoses.push_back(chances_swapped);
  } else if (!has(values, 10 / p) && !has(values, 10)) {
    without_tens.push_back({0, reflection_not_divided});
  }
  judge(holds("values of the lecture's TracePath in a furnace", strange == 0,
              fmt::format("{:g} of {} are others", strange, paths), "0, 1/.9, 10/.9, 100/.9 ...",
              diagnoses));
  Verdict often = mean_is("how often it is 1/.9", first, bernoulli(p));
  if (!often.passed && swapped(values)) often.diagnoses.push_back(chances_swapped);
  judge(often);
  judge(mean_is("how often it is 10/.9", second, bernoulli(p * (1 - p) * rho), without_tens));
  judge(mean_is("how often it is 0", none, bernoulli((1 - p) * (1 - rho) / (1 - (1 - p) * rho))));
}

TEST_CASE("Lab 8.4: mended, a furnace shows 1/(1 - albedo)", "[lab08][ex4]") {
  const Rows rows = trace(mended, furnace_of(0.5, 0.25));
  const std::vector<double> red = column(rows, 0);
  std::vector<Diagnosis> values;
  if (has(red, 1 / p)) values = {still_the_lecture};
  if (has(red, 1 + 1 / p)) values = {into_the_lecture};
  if (values.empty() && loses_half(rows)) values = {self_hit};
  for (const bool dark : {false, true}) {
    Verdict verdict = dark ? mean_is("radiance in a furnace of albedo .25", column(rows, 1),
                                     series(0.5, 0.5), {{1, one_bounce}, {2, no_weight}})
                           : mean_is("radiance in a furnace of albedo .5", red, series(0.5, 1),
                                     {{1, one_bounce}, {0, no_emission}});
    if (!verdict.passed && !values.empty()) verdict.diagnoses = values;
    judge(verdict);
  }
  const Theory exact = series(0.5, 1);
  // The number of bounces is geometric: its excess kurtosis is 6 + (1 - p)^2/p with p = 1/2.
  Verdict spread =
      variance_is("the variance in a furnace of albedo .5", red, {exact.mean, exact.sd, 6.5});
  if (!spread.passed) spread.diagnoses = values;
  judge(spread);
}

TEST_CASE("Lab 8.4: a lamp, and a ball under the sky", "[lab08][ex4]") {
  for (const Method method : {lecture, mended}) {
    const std::string name = method == lecture ? "by the lecture's rule, " : "mended, ";
    const double share = 0.5 * lamp_share;
    // Whoever has p_emit the wrong way about never takes the emission of a black lamp.
    Suspects suspects{{0, self_hit}};
    Suspects dark{{0, sky_missing}};
    if (method == lecture && swapped(column(trace(lecture, furnace_of(0.5, 0.5)), 0))) {
      suspects = dark = {{0, chances_swapped}};
    }
    judge(mean_is(name + "light from a lamp",
                  column(trace(method, with(on_floor, {{"lamp", 0}})), 0),
                  {share, std::sqrt(share * (1 - share))}, suspects));
    judge(mean_is(name + "a glossy ball under the sky", column(trace(method, ball_of(glossy)), 0),
                  ball_theory(), dark));
  }
}

TEST_CASE("Lab 8.6: nothing is counted twice", "[lab08][ex6]") {
  const Moments area = by_area(Lamp::rectangle);
  const double exact = 0.5 * lamp_share;
  judge(mean_is("light from a lamp", column(trace(direct, with(on_floor, {{"lamp", 0}})), 0),
                {exact, area.sd()}, {{2 * exact, counted_twice}, {0, direct_missing}}));
}

TEST_CASE("Lab 8.6: a furnace, with and without what the first surface emits", "[lab08][ex6]") {
  // Emission 1; then rho at each vertex, by area, without variance: within a sphere the cosines and
  // the distance cancel.
  const Theory red = series(0.5, 1), green = series(0.5, 0.5);
  for (const double emission : {1.0, 0.0}) {
    Params params = furnace_of(0.5, 0.25);
    params.numbers["emission"] = emission;
    const Rows rows = trace(direct, params);
    const std::string name = emission == 1 ? "with emission" : "without emission";
    judge(mean_is("radiance in a furnace of albedo .5, " + name, column(rows, 0),
                  {emission + 0.5 * red.mean, 0.5 * red.sd},
                  {{emission + 1.5 * red.mean - 1, counted_twice}, {emission + 0.5, one_bounce}}));
    judge(mean_is("radiance in a furnace of albedo .25, " + name, column(rows, 1),
                  {emission + 0.25 * green.mean, 0.25 * green.sd}));
  }
}

TEST_CASE("Lab 8.6: the sky is no light, and always counts", "[lab08][ex6]") {
  judge(mean_is("a glossy ball under the sky", column(trace(direct, ball_of(glossy)), 0),
                ball_theory(), {{0, sky_missing}}));
}

TEST_CASE("Lab 8.8: the power heuristic", "[lab08][ex8]") {
  const double huge = HUGE_VAL;
  struct Case {
    double p, q, weight;
  };
  for (const Case& c : {Case{1, 1, 0.5},
                        {3, 1, 0.9},
                        {1, 3, 0.1},
                        {2, 0, 1},
                        {0, 2, 0},
                        {1e25, 1e25, 0.5},
                        {1e-25, 3e-25, 0.1},
                        {1, huge, 0},
                        {1e30, 1, 1}}) {
    const Rows rows =
        probe("Lab 8.8 heuristic", {.numbers = {{"p", c.p}, {"q", std::isinf(c.q) ? -1 : c.q}}},
              {.finite = false, .of = fmt::format("p = {:g}, q = {:g}", c.p, c.q)});
    const bool extreme = c.p > 1e20 || (c.p < 1e-20 && c.p > 0) || c.q > 1e20;
    Suspects suspects;
    if (!extreme && c.p != c.q && c.p > 0 && c.q > 0)
      suspects.push_back({c.p / (c.p + c.q), sums_not_squares});
    Verdict verdict = equals(fmt::format("the weight of {:g} beside {:g}", c.p, c.q), rows.at(0, 0),
                             c.weight, 1e-6, suspects);
    if (!verdict.passed && extreme) verdict.diagnoses.push_back(squares_overflow);
    judge(verdict);
  }
}

TEST_CASE("Lab 8.8: the density of light points", "[lab08][ex8]") {
  for (const Lamp lamp : {Lamp::rectangle, Lamp::sphere, Lamp::two}) {
    const Rows rows = probe("Lab 8.8 light pdf", {.numbers = {{"lamp", static_cast<double>(lamp)}}},
                            {.rows = 40, .columns = 5, .of = name_of(lamp)});
    double wrong = 0, uncounted = 0, flat = 0, near = 0, lit = 0;
    for (std::size_t i = 0; i < rows.count(); ++i) {
      const double d2 = rows.at(i, 1), cosine = rows.at(i, 2), area = rows.at(i, 3);
      const double exact = area == 0 ? 0 : d2 / (cosine * area * rows.at(i, 4));
      const auto is = [&](double value) {
        return std::abs(rows.at(i, 0) - value) <= 1e-4 * std::abs(value) ? 1 : 0;
      };
      wrong += 1 - is(exact);
      lit += area > 0 ? 1 : 0;
      if (area == 0) continue;
      uncounted += is(exact * rows.at(i, 4));
      flat += is(exact * cosine);
      near += is(exact / d2);
    }
    std::vector<Diagnosis> diagnoses;
    if (lamp == Lamp::two && uncounted == lit) diagnoses.push_back(light_choice);
    if (flat == lit) diagnoses.push_back(no_cosine);
    if (near == lit) diagnoses.push_back(no_distance_in_pdf);
    judge(holds(fmt::format("light_pdf, {}", lamp == Lamp::two      ? "two lamps"
                                             : lamp == Lamp::sphere ? "a ball"
                                                                    : "a square lamp"),
                wrong == 0 && lit > 0, fmt::format("{:g} of {} differ", wrong, rows.count()),
                "distance^2/(cos area lights); 0 for what does not emit", diagnoses));
  }
}

TEST_CASE("Lab 8.8: closed forms, at every length of path", "[lab08][ex8]") {
  // Standard deviations are bounds: three halves of what a right solution shows (no closed form).
  for (const double depth : {1.0, 2.0, 3.0, 0.0}) {
    const Rows rows = trace_all(furnace_of(0.5, 0.25), depth);
    const double red = depth == 0 ? 2 : 2 * (1 - std::pow(0.5, depth));
    const double next = depth == 0 ? 2 : 2 * (1 - std::pow(0.5, depth + 1));
    const std::string name = depth == 0 ? "of any length" : fmt::format("of {:g} segments", depth);
    judge(mean_is("radiance in a furnace, paths " + name, column(rows, 0),
                  {red, depth == 1 ? 1e-3 : 1.5},
                  {{next, depth_slips}, {1 + 2 * (red - 1), both_whole}, {2 * red, both_whole}}));
    const std::vector<double> twice = column(rows, 3), film = column(rows, 4);
    const auto zero = [](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [](double x) { return x == 0; });
    };
    if (depth == 0) {
      judge(is_so("random numbers of a path", zero(twice) && zero(film),
                  zero(twice) ? "some are the film's" : "some are read twice",
                  "each read once at most", {read_twice}));
    }
  }
}

TEST_CASE("Lab 8.8: a lamp, a glossy ball, glass", "[lab08][ex8]") {
  const double exact = 0.5 * lamp_share;
  judge(mean_is("light from a lamp", column(trace_all(with(on_floor, {{"lamp", 0}}), 0), 0),
                {exact, 0.15}, {{2 * exact, both_whole}}));
  judge(mean_is("a glossy ball under the sky", column(trace_all(ball_of(glossy), 0), 0),
                ball_theory(), {{0, sky_missing}}));
  judge(mean_is("radiance in a furnace around a glass ball",
                column(trace_all(with(with_glass, {{"r", 0.5}, {"g", 0.5}, {"b", 0.5}}), 0), 0),
                {2, 2}));
}

TEST_CASE("Lab 8.8: a lamp in a mirror and behind glass, seen by a rough surface", "[lab08][ex8]") {
  // A path brings the lamp's radiance 1 or nothing, and more than 1 where roulette might have ended
  // it: the sd is a bound, twice that of a path that it spares. Less than 1 is a weight: the one
  // that the vertex before would give leaves a fiftieth of the light, which is 18 standard errors
  // too little.
  for (const Place place : {by_mirror, by_pane}) {
    const double exact = 0.5 * (place == by_mirror ? mirrored_share() : lamp_share);
    const std::vector<double> seen = column(trace_all(with(place, {}), 0, false), 0);
    Verdict verdict =
        mean_is(place == by_mirror ? "light from a lamp in a mirror" : "light through a pane", seen,
                {exact, 2 * std::sqrt(exact)});
    // No comparison is true of NaN, and power_heuristic(0, 0) may well be that.
    const bool weighed =
        std::none_of(seen.begin(), seen.end(), [](double x) { return x >= 0.999; });
    if (!verdict.passed && weighed) verdict.diagnoses.push_back(kept_across);
    judge(verdict);
  }
}

TEST_CASE("Lab 8.8: roulette ends paths and keeps the mean", "[lab08][ex8]") {
  // A sphere of mirror inside: throughput .6, .36, .216 ...: each vertex from the third on is a
  // bet. Without compensation each bet that is won leaves the throughput as it is.
  double throughput = 1, alive = 1, uncompensated = 0;
  for (int vertex = 0; vertex < 40; ++vertex) {
    uncompensated += alive * throughput;
    throughput *= 0.6;
    alive *= std::min(1.0, 4 * throughput);
  }
  judge(mean_is("radiance in a furnace of mirrors of reflectance .6",
                column(trace_all(with(in_mirrors, {{"r", 0.6}, {"g", 0.6}, {"b", 0.6}}), 0), 0),
                {2.5, 1.5}, {{uncompensated, no_compensation}}));
}
