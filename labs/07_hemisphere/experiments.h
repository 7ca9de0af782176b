#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"
#include "hemisphere.h"

namespace lab07 {

using carlo::Curve, carlo::Measurement, carlo::Notebook;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 7.2 to 7.6: the directions of each sampler, in a rotatable picture and against their
/// densities.
void samplers_experiment(Notebook& notebook);
/// Lab 7.1: how far frames deviate from right angles.
void frames_experiment(Notebook& notebook);
/// Lab 7.5: lobes as they become narrow.
void lobe_experiment(Notebook& notebook);
/// Lab 7.6: the part of a lobe that is lost below the horizon.
void mirror_experiment(Notebook& notebook);
/// Lab 7.7: images of irradiance and ambient occlusion, error against directions and seconds.
void images_experiment(Notebook& notebook);
/// Lab 7.7: the variance of lobes around the normal, by their exponent.
void exponents_experiment(Notebook& notebook);
/// Lab 7.8: surfaces under an image of a sky, error against directions and seconds.
void light_experiment(Notebook& notebook);

}  // namespace lab07
