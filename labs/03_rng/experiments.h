#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"

namespace lab03 {

using carlo::Notebook;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 3.1 and 3.8: the planes on which an LCG's triples lie, in a rotatable picture, and the
/// distances between them.
void planes_experiment(Notebook& notebook);
/// Labs 3.1 to 3.4 and 3.7: which test catches which generator.
void battery_experiment(Notebook& notebook);
/// Labs 3.1, 3.3 and 3.4: what a weak generator does to an estimate.
void estimates_experiment(Notebook& notebook);
/// Labs 3.5 and 3.6: floats that reach 1, integers that are favoured.
void conversions_experiment(Notebook& notebook);
/// Labs 3.1 to 3.4: nanoseconds per number, compared with the standard library.
void speed_experiment(Notebook& notebook);

}  // namespace lab03
