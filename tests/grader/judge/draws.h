#pragma once

#include "grader/judge/compare.h"

namespace carlo::grader {

/// How many numbers an exercise took from its generator, which gave `words` 32-bit words (-1: not
/// known; worker/words_drawn.h). A uniform double takes two.
Verdict draws(double words, double expected);

}  // namespace carlo::grader
