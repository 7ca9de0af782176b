#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 4,
      .title = "Lab 04: stratification",
      .subtitle = "Points that keep their distance: the same number of them, and less error.",
      .n = 1 << 16,
      .quick_n = 1 << 14,
      .experiments = {lab04::point_sets_experiment, lab04::line_experiment, lab04::float_experiment,
                      lab04::slopes_experiment, lab04::variance_experiment,
                      lab04::recursive_experiment},
      .what_you_should_see = {
          "Strata never hurt, and where a function is smooth they change the slope: on the line "
          "from -1/2 to -3/2, in the square to -1. An edge costs part of it: -1 on the line, -3/4 "
          "in the square.",
          "A Latin hypercube stratifies every axis and no cell: its slope stays at -1/2, though "
          "its "
          "line lies lower, most of all where f is nearly a sum of functions of one coordinate.",
          "Scrambled Sobol' points are stratified in all elementary boxes at once: nearly -3/2 for "
          "the smooth function, and -3/4 like jittered points at an edge.",
          "The error bars of Lab 4.5 hold the truth about 95 times in 100, and the error that they "
          "give for points without strata stays the same however many cells there are.",
          "Recursive strata gather where the integrand varies. On the narrow peak and on the "
          "disc they pass the fixed grid once there are points enough; with few points the ones "
          "that explore, and the boxes in which they missed the edge, cost more than they save."}};
  return carlo::run_lab(lab, argc, argv);
}
