#include "course/report/lab_app.h"
#include "experiments.h"

int main(int argc, char** argv) {
  const carlo::LabApp lab{
      .number = 5,
      .title = "Lab 05: inversion and rejection",
      .subtitle = "Points of any density from uniform numbers, and what each of them costs.",
      .experiments = {lab05::densities_experiment, lab05::rejection_experiment,
                      lab05::convergence_experiment, lab05::tables_experiment,
                      lab05::image_experiment, lab05::disc_experiment},
      .what_you_should_see = {
          "Histograms that follow their densities, and p-values that are neither tiny nor all "
          "close to 1: each is uniform on [0, 1] when sampler and density belong together.",
          "Rejection keeps the share of darts that theory says. Its cost grows like one over that "
          "share, while an inverse CDF costs the same whatever its shape; where most darts are "
          "kept, as in the disc, a dart can be cheaper than a root, a sine and a cosine.",
          "The same error at the same number of samples, whichever way they were made: only the "
          "seconds differ.",
          "Bisection that grows slowly with the logarithm of the table's size, until the table no "
          "longer fits the processor's caches. A CDF summed in float that misses 1.",
          "Bright parts of the image dense with points, black ones empty.",
          "Two uniform discs, and one with a crowded centre."}};
  return carlo::run_lab(lab, argc, argv);
}
