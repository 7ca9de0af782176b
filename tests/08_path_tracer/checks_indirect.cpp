// Checks of exercise 8.6: worlds with closed forms, 50 000 paths each.

#include "08_path_tracer/paths.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis counted_twice{
    "emission-counted-twice",
    "light that direct_by_area() has counted is counted again where a ray hits the light."};
const Diagnosis direct_missing{"direct-light-missing",
                               "light straight from the lights is missing."};

/// Judges paths; if absorbed paths contribute nothing, that explains all failures.
void judge_direct(Verdict verdict) {
  if (!verdict.passed && ends_dark(column(trace(direct, furnace_of(0.5, 0.25)), 0)))
    verdict.diagnoses = {absorbed_dark};
  judge(verdict);
}

}  // namespace

TEST_CASE("Lab 8.6: nothing is counted twice", "[lab08][ex6]") {
  const Moments area = by_area(Light::rectangle);
  const double exact = 0.5 * light_path_share;
  judge_direct(mean_is("light from a light source",
                       column(trace(direct, with(on_floor, {{"light", 0}})), 0), {exact, area.sd()},
                       {{2 * exact, counted_twice}, {0, direct_missing}}));
}

TEST_CASE("Lab 8.6: a furnace, with and without what the first surface emits", "[lab08][ex6]") {
  // Emission 1; then rho at each vertex, by area, without variance: inside a sphere the cosines and
  // the distance cancel.
  const Theory red = series(0.5, 1), green = series(0.5, 0.5);
  for (const double emission : {1.0, 0.0}) {
    Params params = furnace_of(0.5, 0.25);
    params.numbers["emission"] = emission;
    const Rows rows = trace(direct, params);
    const std::string name = emission == 1 ? "with emission" : "without emission";
    judge_direct(
        mean_is("radiance in a furnace of albedo .5, " + name, column(rows, 0),
                {emission + 0.5 * red.mean, 0.5 * red.sd},
                {{emission + 1.5 * red.mean - 1, counted_twice}, {emission + 0.5, one_bounce}}));
    judge_direct(mean_is("radiance in a furnace of albedo .25, " + name, column(rows, 1),
                         {emission + 0.25 * green.mean, 0.25 * green.sd}));
  }
}

TEST_CASE("Lab 8.6: the sky is no light, and always counts", "[lab08][ex6]") {
  judge_direct(mean_is("a glossy ball under the sky", column(trace(direct, ball_of(glossy)), 0),
                       ball_theory(), {{0, sky_missing}}));
}
