#include "course/report/lab_app.h"
#include "experiments.h"

#include <vector>

namespace {

std::vector<carlo::Step> steps() {
  return {
      {"a",
       {lab08::camera_experiment},
       "a. Jagged spokes from one ray a pixel, smooth ones from 16; stratified rays have a slope "
       "between -1/2 and -3/4 (here -0.63) where independent ones have -1/2, at no more cost."},
      {"b",
       {lab08::direct_experiment, lab08::scales_experiment},
       "b. The same soft shadow in both forms, with slopes of -1/2. By area the error is many "
       "times smaller: all rays go where the light is. Then: shadow rays that start a fixed "
       "distance off the surface fail in a small world and in a large one."},
      {"c",
       {lab08::phong_experiment},
       "c. Reflectances that agree with the closed form at every angle and exponent. Uniform "
       "directions get worse with n, sample()'s directions do not."},
      {"d",
       {lab08::furnace_experiment},
       "d. The lecture's rule stays below 2 most of the time, with error bars that leave 2 out; "
       "now and then a single path throws it far above. Corrected, the error falls with -1/2 and "
       "one interval in twenty misses, as it should."},
      {"e",
       {lab08::split_experiment},
       "e. One ray for the light and one for the rest: a fraction of the noise of uniform "
       "directions. The weights as printed in the lecture are far off. A ball that shrinks at "
       "constant power goes dark when its cone is 1 - cos in float."},
      {"f",
       {lab08::indirect_experiment},
       "f. Without indirect light the ceiling is black and shadows are ink; with it walls colour "
       "one another. Lights sampled by area: far less noise than waiting for paths to meet them. "
       "The lecture's two pictures: 40 paths a pixel are noise, 1200 a picture with grain."},
      {"g",
       {lab08::specular_experiment},
       "g. A bright caustic under the glass ball, made of few bright samples: this is where the "
       "noise is."},
      {"h",
       {lab08::tracer_experiment},
       "h. On the diffuse Cornell box the two weighted techniques gain nothing over points of the "
       "light alone and cost a little; what pays are Sobol' points, at nearly the same price. On "
       "the plates neither technique is good everywhere, and both together are."},
      {"recap",
       {lab08::recap_experiment, lab08::recap_box_experiment},
       "The Recap. As printed it is far off in every room, each bounce by its own factor, and "
       "where nothing but the light emits no path ends by itself. Corrected, it is right."}};
}

}  // namespace

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 8,
      .title = "Lab 08: a path tracer",
      .subtitle = "From camera rays to caustics in eight steps, each beside its closed form.",
      .n = 1 << 20,
      .quick_n = 1 << 18,  // 64 samples per pixel: a slope from fewer points is meaningless
      .steps = steps(),
      .step_names = "a to h, or the lecture's Recap"};
  return carlo::run_lab(lab, argc, argv);
}
