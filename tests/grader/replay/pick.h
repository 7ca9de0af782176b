#pragma once

#include "grader/judge/asked.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// Returns the questions as a table: number, probe, what was asked and the outcome, below the
/// sentences of the tests that asked.
std::string listing(const std::vector<Asked>& asked);

/// Returns the question with a number in the listing ("3") or, for a probe's name, its first one
/// without values, else its first one. Throws Error that says what there is.
const Asked& pick(const std::vector<Asked>& asked, const std::string& what);

/// Returns its number in the listing, from 1.
std::size_t number_of(const std::vector<Asked>& asked, const Asked& one);

}  // namespace carlo::grader
