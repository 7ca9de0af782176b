#pragma once

#include "grader/judge/compare.h"
#include "grader/protocol/next_words.h"
#include "random/rng.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// Checks how many numbers an exercise took from its generator, which gave `words` 32-bit words
/// (-1: unknown). A uniform double takes two.
Verdict draws(double words, double expected);

/// The same for a generator that started as `before` and whose next words are `next`.
Verdict draws(const Rng& before, const NextWords& next, double expected);

/// Checks that points come from the first numbers that rng.uniform() returns from `before` on:
/// their places in their intervals, as shares in [0, 1), are each u or 1 - u, in any order. Reveals
/// points that were not drawn, whatever count is claimed.
Verdict made_of(const std::string& what, std::vector<double> shares, Rng before);

}  // namespace carlo::grader
