#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"

namespace lab01 {

using carlo::Curve, carlo::curves_of, carlo::ExpectedCurve, carlo::Measurement, carlo::Notebook,
    carlo::Summary, carlo::Trial;
using carlo::slope_table, carlo::error_charts, carlo::ladder, carlo::measurement_table,
    carlo::repeat, carlo::slope_cell, carlo::time_rule;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Lab 1.1: the error of an average against N; slope -1/2.
void average_experiment(Notebook& notebook);
/// Labs 1.2 and 1.4: Monte Carlo beside midpoint, trapezoid and Simpson.
void rules_experiment(Notebook& notebook);
/// Labs 1.5 and 1.6: the curse of dimensionality.
void dimensions_experiment(Notebook& notebook);
/// Labs 1.2, 1.3 and 1.4: a jump, singularities and a rare spike.
void hard_integrands_experiment(Notebook& notebook);
/// Lab 1.3: variances of numbers with a large mean.
void variance_experiment(Notebook& notebook);
/// Lab 1.7: balls, and whether the error bars are right.
void domain_experiment(Notebook& notebook);

}  // namespace lab01
