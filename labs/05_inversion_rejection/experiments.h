#pragma once

#include "course/report/measure.h"
#include "course/report/notebook.h"

namespace lab05 {

using carlo::Notebook, carlo::seconds_a_draw;

// One function per experiment: it runs the exercises it needs, and writes its findings.

/// Labs 5.1, 5.2, 5.3 and 5.5: histograms against densities, and inversion by hand.
void densities_experiment(Notebook& notebook);
/// Lab 5.7 beside 5.1 to 5.3: which darts are kept, how many it takes, and the cost of a sample.
void rejection_experiment(Notebook& notebook);
/// Labs 5.3 and 5.7: the error of a mean, by samples of both kinds.
void convergence_experiment(Notebook& notebook);
/// Lab 5.4: from ten to ten million weights.
void tables_experiment(Notebook& notebook);
/// Lab 5.6: an image and the points drawn from it.
void image_experiment(Notebook& notebook);
/// Lab 5.8: points in a disc, both ways and a wrong one.
void disc_experiment(Notebook& notebook);

}  // namespace lab05
