#include "experiments.h"

// Step a: bias and noise apart.

namespace lab09 {

void error_experiment(Notebook& notebook) {
  notebook.begin("Step a: bias and noise apart");
}

}  // namespace lab09
