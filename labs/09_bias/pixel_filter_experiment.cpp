#include "experiments.h"

// Step b: pixel filters.

namespace lab09 {

void pixel_filter_experiment(Notebook& notebook) {
  notebook.begin("Step b: pixel filters");
}

}  // namespace lab09
