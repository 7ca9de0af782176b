#include "experiments.h"

// Step c: a filter that knows edges.

namespace lab09 {

void feature_filter_experiment(Notebook& notebook) {
  notebook.begin("Step c: a filter that knows edges");
}

}  // namespace lab09
