#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 6,
      .title = "Lab 06: importance sampling",
      .subtitle =
          "More samples where f is bigger: what p does to the variance, when it goes wrong, "
          "and two densities at once.",
      .experiments = {lab06::shapes_experiment, lab06::convergence_experiment,
                      lab06::tails_experiment, lab06::fog_experiment, lab06::rejection_experiment,
                      lab06::weights_experiment, lab06::plates_experiment},
      .what_you_should_see = {
          "The variance of f/p falls to 0 as p approaches f, on either side of it. Up to n = 17/3 "
          "the measured values lie on the closed form; from there to n = 9, where it becomes "
          "infinite, most are too small.",
          "Any p that covers f gives the right mean. A better p shifts the line of the error down "
          "and leaves its slope at -1/2; one that is 0 where f is not ends on a bias.",
          "A p that is too thin in the tails breaks the slope. Its runs look calm and are too "
          "low until a single sample lifts them; Hill's index and the largest share tell without "
          "the exact value being known. Mixing in a tenth of a uniform density cures it.",
          "Rejection samples need no integral of g when lost darts count as zeros.",
          "Of the light's and the fog's density, and of the plates' two techniques, each fails "
          "where the other is good. With weights the combination stays close to the better one "
          "everywhere, at the price of halving its samples."}};
  return carlo::run_lab(lab, argc, argv);
}
