#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"
#include "path_tracer.h"

namespace lab08 {

using carlo::Curve, carlo::Measurement, carlo::Notebook;

// One or two functions per step: each renders the step's small scene with the exercises it needs,
// and writes its findings.

/// Step a, Lab 8.1: spokes and a checkerboard, stratified and not.
void camera_experiment(Notebook& notebook);
/// Step b, Lab 8.2: the soft shadow of a square under a square light, in both forms.
void direct_experiment(Notebook& notebook);
/// Step b: one scene at six scales, and shadow rays with a fixed offset.
void scales_experiment(Notebook& notebook);
/// Step c, Lab 8.3: glossy balls under the sky.
void phong_experiment(Notebook& notebook);
/// Step d, Lab 8.4: a furnace, and error bars that are too short.
void furnace_experiment(Notebook& notebook);
/// Step e, Lab 8.5: a floor under a small bright ball and a dim sky.
void split_experiment(Notebook& notebook);
/// Step f, Lab 8.6: the Cornell box, direct light alone and all light.
void indirect_experiment(Notebook& notebook);
/// Step g, Lab 8.7: balls of mirror and of glass.
void specular_experiment(Notebook& notebook);
/// Step h, Lab 8.8: the path tracer beside the earlier steps at equal time; samplers; plates.
void tracer_experiment(Notebook& notebook);
/// The lecture's Recap as printed and as corrected, in rooms with closed forms.
void recap_experiment(Notebook& notebook);
/// The same in the Cornell box.
void recap_box_experiment(Notebook& notebook);

}  // namespace lab08
