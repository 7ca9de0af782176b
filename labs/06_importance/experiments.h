#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"

#include <algorithm>
#include <cstdint>

namespace lab06 {

using carlo::Curve, carlo::Measurement, carlo::Notebook, carlo::Summary, carlo::Trial;
using carlo::error_charts, carlo::ladder, carlo::measurement_table, carlo::repeat,
    carlo::best_seconds, carlo::slope_cell;

/// The number of repetitions: more where they are cheap, so that slopes are not lost in noise.
inline int repetitions(const Notebook& notebook, std::int64_t n) {
  const std::int64_t wanted = 2'000'000 / n;
  return notebook.repetitions(static_cast<int>(std::clamp<std::int64_t>(wanted, 400, 4000)));
}

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 6.1 and 6.2: f, p and f/p; the variance along a family of densities.
void shapes_experiment(Notebook& notebook);
/// Lab 6.1: error against N and seconds for good and bad densities, and for one with too thin a
/// tail.
void convergence_experiment(Notebook& notebook);
/// Lab 6.4: how a tail that is too thin shows, and its cure.
void tails_experiment(Notebook& notebook);
/// Lab 6.3: a light in fog; with Lab 6.7 the mixture of its two techniques.
void fog_experiment(Notebook& notebook);
/// Lab 6.5: rejection samples, used directly.
void rejection_experiment(Notebook& notebook);
/// Lab 6.6: weights of extreme pdfs.
void weights_experiment(Notebook& notebook);
/// Labs 6.6 and 6.7: Veach's plates on the line.
void plates_experiment(Notebook& notebook);

}  // namespace lab06
