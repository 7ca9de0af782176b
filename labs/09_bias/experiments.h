#pragma once

#include "bias.h"
#include "course/report/measure.h"
#include "course/report/notebook.h"

#include <string>
#include <vector>

namespace lab09 {

using carlo::Curve, carlo::Measurement, carlo::Notebook;

// One or two functions per step: each renders the step's small scene with the exercises it needs,
// and writes its findings.

/// Step a, Lab 9.1: clamped samples of a fat tail, beside their closed form.
void error_experiment(Notebook& notebook);
/// Step b, Lab 9.2: pixel filters.
void pixel_filter_experiment(Notebook& notebook);
/// Step c, Lab 9.3: a noisy image, filtered.
void feature_filter_experiment(Notebook& notebook);
/// Step d, Lab 9.4: where photons land.
void photons_experiment(Notebook& notebook);
/// Step e, Lab 9.5: irradiance from photons, where it is known; and a caustic by photons.
void density_experiment(Notebook& notebook);
void caustic_experiment(Notebook& notebook);
/// Step f, Lab 9.6: discs that shrink, and others that do not, where the radiance is known; and the
/// caustic again, pass by pass.
void progressive_experiment(Notebook& notebook);
void progressive_image_experiment(Notebook& notebook);
/// Step g, Lab 9.7: irradiance where it was not computed.
void irradiance_cache_experiment(Notebook& notebook);
/// Step g, Lab 9.7: irradiance where it does not belong.
void leak_experiment(Notebook& notebook);
/// All of them beside lab 8's path tracer: error against time.
void practice_experiment(Notebook& notebook);
/// The options of practice_experiment().
struct PracticeOptions {
  double seconds = 0;  ///< of one thread, for each image; 0: 1, or .25 in a quick run
  std::string scene;   ///< only this one of practice_scenes; empty: all, or the first in a quick
                       ///< run
};
inline PracticeOptions practice_options;
inline const std::vector<std::string> practice_scenes = {"caustics", "indirect", "big_light",
                                                         "soft_shadows"};

}  // namespace lab09
