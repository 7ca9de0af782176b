#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"

namespace lab02 {

using carlo::Curve, carlo::Measurement, carlo::Notebook, carlo::Summary, carlo::Trial;
using carlo::error_charts, carlo::ladder, carlo::measurement_table, carlo::repeat,
    carlo::slope_cell;

/// For the normal distribution, 95 % lie within this many standard deviations.
constexpr double z95 = 1.959963984540054;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 2.1 and 2.2: darts on their board, and the estimate as it settles down within its interval.
void board_experiment(Notebook& notebook);
/// Labs 2.1 and 2.2: how often 95 % intervals hold the truth.
void coverage_experiment(Notebook& notebook);
/// Labs 2.1, 2.3, 2.4 and 2.5: the estimators' errors, their constants and their costs.
void estimators_experiment(Notebook& notebook);
/// Lab 2.5: darts per second, and a counter of type float.
void fast_experiment(Notebook& notebook);
/// Lab 2.6: threads against time, and the bits of the sums.
void threads_experiment(Notebook& notebook);

}  // namespace lab02
