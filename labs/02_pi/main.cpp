#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 2,
      .title = "Lab 02: π by darts",
      .subtitle =
          "Error bars that keep their promise, estimators worth their time, and threads "
          "that do not change the answer.",
      .experiments = {lab02::board_experiment, lab02::coverage_experiment,
                      lab02::estimators_experiment, lab02::fast_experiment,
                      lab02::threads_experiment},
      .what_you_should_see = {
          "The estimate wanders inside an interval that narrows with the root of N: a hundred "
          "times the darts for one more digit.",
          "The score interval holds the truth in 95 of 100 runs, give or take two or three where N "
          "is small. The estimate ± 1.96 standard errors does so only when there are many hits and "
          "many misses.",
          "All estimators have slope -1/2. They differ by a constant: the variance of a sample, "
          "which paper gives exactly, and the time of a sample, which it does not.",
          "Whole numbers, no branch and every random bit used make a dart several times as fast. "
          "Efficiency, 1/(variance × time), says which of the estimators that is worth.",
          "A counter of type float makes π fall as N grows.",
          "The same bits for any number of threads."}};
  return carlo::run_lab(lab, argc, argv);
}
