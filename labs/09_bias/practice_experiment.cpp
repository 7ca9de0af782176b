#include "experiments.h"

// "Noise removal (filtering) and irradiance caching (photon maps) used in practice", measured.

namespace lab09 {

void practice_experiment(Notebook& notebook) {
  notebook.begin("In practice");
}

}  // namespace lab09
