#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 1,
      .title = "Lab 01: integration",
      .subtitle = "Averages, rules and dice: what an integral costs, in points and in seconds.",
      .experiments = {lab01::average_experiment, lab01::rules_experiment,
                      lab01::dimensions_experiment, lab01::hard_integrands_experiment,
                      lab01::variance_experiment, lab01::domain_experiment},
      .what_you_should_see = {
          "Monte Carlo's error falls with slope -1/2: four times the points, half the error, in "
          "any dimension and for anything of finite variance.",
          "In one dimension the rules leave it far behind: -2 for midpoint and trapezoid, -4 for "
          "Simpson, down to the rounding errors. Nested in d dimensions the -2 becomes -2/d: "
          "steeper than -1/2 below d = 4, flatter above.",
          "Where the variance is infinite, Monte Carlo converges more slowly and its error bars "
          "are not to be trusted; a rare spike fools them until it has been hit often.",
          "A variance by Welford's update does not care how large the mean is.",
          "Error bars of Lab 1.7 hold the exact volume about 95 times in 100."}};
  return carlo::run_lab(lab, argc, argv);
}
