#pragma once

#include "bias.h"
#include "report/measure.h"
#include "report/notebook.h"

namespace lab09 {

using carlo::Curve, carlo::Measurement, carlo::Notebook;

// One experiment a step, or two: it renders the step's small scene with the exercises it needs, and
// writes what it finds.

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
/// caustic once more, pass by pass.
void progressive_experiment(Notebook& notebook);
void progressive_image_experiment(Notebook& notebook);
/// Step g, Lab 9.7: irradiance where it was not computed.
void irradiance_cache_experiment(Notebook& notebook);
/// Step g, Lab 9.7: irradiance where it does not belong.
void leak_experiment(Notebook& notebook);
/// All of them beside lab 08's path tracer: error against time.
void practice_experiment(Notebook& notebook);
/// The seconds of one thread that practice_experiment() gives each image; 0: 1, or .1 in a quick
/// run.
inline double practice_seconds = 0;

}  // namespace lab09
