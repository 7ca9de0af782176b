#pragma once

#include "grader/judge/compare.h"
#include "grader/protocol/next_words.h"
#include "random/rng.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// How many numbers an exercise took from its generator, which gave `words` 32-bit words (-1: not
/// known). A uniform double takes two.
Verdict draws(double words, double expected);

/// The same for a generator that started as `before` and would go on with the words `next`.
Verdict draws(const Rng& before, const NextWords& next, double expected);

/// Where points lie in their intervals, as shares in [0, 1), follows from the first numbers that
/// rng.uniform() gives from `before` on: each u or 1 - u, in any order. Points that nobody drew
/// show here, whatever is claimed of them.
Verdict made_of(const std::string& what, std::vector<double> shares, Rng before);

}  // namespace carlo::grader
