#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"
#include "point_sets.h"

namespace lab04 {

using carlo::Curve, carlo::curves_of, carlo::ExpectedCurve, carlo::Measurement, carlo::Notebook,
    carlo::Summary, carlo::Trial;
using carlo::slope_table, carlo::error_charts, carlo::ladder, carlo::measurement_table,
    carlo::repeat, carlo::slope_cell;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 4.3 and 4.4: what the point sets look like, and which strata they leave empty.
void point_sets_experiment(Notebook& notebook);
/// Lab 4.1: strata on the line, for a smooth function and one that jumps.
void line_experiment(Notebook& notebook);
/// Lab 4.2: strata in float.
void float_experiment(Notebook& notebook);
/// Labs 4.3 and 4.4: slopes of five point sets, smooth and with an edge; pi with strata.
void slopes_experiment(Notebook& notebook);
/// Lab 4.5: the variance before and after, and whether the error bars are right.
void variance_experiment(Notebook& notebook);
/// Lab 4.6: strata that adapt.
void recursive_experiment(Notebook& notebook);

}  // namespace lab04
