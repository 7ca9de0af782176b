#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 7,
      .title = "Lab 07: directions",
      .subtitle = "The hemisphere and the lobe: which way to look, and what each way costs.",
      .experiments = {lab07::samplers_experiment, lab07::frames_experiment, lab07::lobe_experiment,
                      lab07::mirror_experiment, lab07::images_experiment,
                      lab07::exponents_experiment, lab07::light_experiment},
      .what_you_should_see = {
          "Directions that fill the hemisphere as their densities say: evenly, thicker towards the "
          "normal, in a narrow bundle. p-values that are neither tiny nor all close to 1.",
          "Axes at right angles to a few 1e-7 for every normal, and a frame from one helper vector "
          "that loses its digits one by one as the normal approaches the helper.",
          "A lobe that stays right to n = 1e7, where the recipe with acos in float has some twenty "
          "angles left.",
          "Noise that falls with slope -1/2 for every technique. Cosine-weighted directions beat "
          "uniform ones where light comes from everywhere; a lobe aimed at a light source beats both by "
          "far. Rejection and inversion have the same error at the same number of directions, and "
          "differ in seconds only.",
          "A variance that is 0 where the density is proportional to what is integrated, and "
          "infinite where it is too thin: a lobe of n = 3 around the normal is one step too far.",
          "Directions drawn from an image that go where its light comes from. Under a sky with a "
          "sun they beat all others; on a wall that the sun does not reach they are the worst, and "
          "both kinds together are good everywhere."}};
  return carlo::run_lab(lab, argc, argv);
}
