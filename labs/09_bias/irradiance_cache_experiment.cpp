#include "experiments.h"

// Step g: an irradiance cache.

namespace lab09 {

void irradiance_cache_experiment(Notebook& notebook) {
  notebook.begin("Step g: an irradiance cache");
}

}  // namespace lab09
