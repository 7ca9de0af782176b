#include "course/cli/arguments.h"
#include "course/report/lab_app.h"
#include "experiments.h"

#include <vector>

namespace {

/// Each with the seconds that its experiments take on one core, on average.
std::vector<carlo::Step> steps() {
  return {
      {"a",
       {lab09::error_experiment},
       "a. The best clamp moves: the more samples, the less bias is worth. A clamp that was "
       "chosen for 16 samples lowers the error there to less than half; from some 180 samples on "
       "not clamping is better, as the estimates with 16 samples predicted.",
       7},
      {"b",
       {lab09::pixel_filter_experiment},
       "b. Spokes that are too fine appear through the box as rings and other spokes, through "
       "the wider filters hardly at all; these blur the coarse ones a little. Offsets drawn from "
       "the filter have no bias. Weighted ones have some at first: it falls as 1/n, so that soon "
       "only noise is left, and more of it than with drawn offsets.",
       14},
      {"c",
       {lab09::feature_filter_experiment},
       "c. Filtered by colours and features, 16 samples have the error of some 40. By features alone "
       "the shadows blur, and more samples do not bring them back: all that is left is bias. With "
       "colours the bias falls as the noise does.",
       7},
      {"d",
       {lab09::photons_experiment},
       "d. Dots that are dense where much light arrives: most of all in the caustic below the "
       "ball of glass. Counts under a point light follow I cos/d^2, and their noise falls as the "
       "root of their number. A disc wide enough to have little noise blurs the irradiance at "
       "its middle. In a closed sphere all power arrives, 1/(1 - albedo) times.",
       7},
      {"e",
       {lab09::density_experiment, lab09::caustic_experiment},
       "e. Wide discs: little noise, much bias; small ones the other way round, both as theory "
       "predicts. Half of the light is missing at a floor's edge. The caustic is there at once, "
       "where paths of the same time show noise.",
       4},
      {"f",
       {lab09::progressive_experiment, lab09::progressive_image_experiment},
       "f. A fixed radius ends at its bias, a shrinking one continues with a slope of about "
       "-1/3. Paths have -1/2, once they find the light.",
       10},
      {"g",
       {lab09::irradiance_cache_experiment, lab09::leak_experiment},
       "g. Records crowd along edges. More directions reduce the noise and leave the bias: the "
       "curves of coarse caches flatten, one after the other, and all of them lie below that of "
       "paths. Light leaks through a thin wall as soon as records reach across it, and through a "
       "board where the test for records in front fails.",
       4},
      {"practice",
       {lab09::practice_experiment},
       "In practice. After a second the photon maps are far ahead where light is gathered by "
       "glass or comes by way of walls, and filtered paths where it comes straight; the path "
       "tracer is ahead nowhere. But one radius has one bias: after seconds to minutes the path "
       "tracer overtakes it, and the irradiance cache too. In an hour the consistent methods win.",
       73}};
}

}  // namespace

int main(int argc, char** argv) {
  carlo::LabApp lab{.number = 9,
                    .title = "Lab 09: bias for noise",
                    .subtitle =
                        "Filters, photon maps and irradiance caches, with their bias and "
                        "their noise apart.",
                    .n = 1 << 20,
                    .quick_n = 1 << 18,
                    .steps = steps(),
                    .step_names = "a to g, or all methods side by side"};
  lab.add_options = [](carlo::CommandLine& app) {
    app.option("--seconds", lab09::practice_options.seconds,
               "of one thread, for each image of --step practice (1; .25 in a quick run)")
        .range(0.01, 3600.0);
    app.option("--scene", lab09::practice_options.scene, "the scene of --step practice (all)")
        .one_of(lab09::practice_scenes);
  };
  return carlo::run_lab(lab, argc, argv);
}
