#include "experiments.h"

// Step e: radiance from photons.

namespace lab09 {

void density_experiment(Notebook& notebook) {
  notebook.begin("Step e: radiance from photons");
}

}  // namespace lab09
