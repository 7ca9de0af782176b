#include "experiments.h"

// Step d: photons from the lamps.

namespace lab09 {

void photons_experiment(Notebook& notebook) {
  notebook.begin("Step d: photons from the lamps");
}

}  // namespace lab09
