#include "experiments.h"

// Step f: ever smaller discs.

namespace lab09 {

void progressive_experiment(Notebook& notebook) {
  notebook.begin("Step f: ever smaller discs");
}

}  // namespace lab09
