#pragma once

#include "grader/judge/asked.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// The questions as a table: number, probe, what was asked and how it ended, below the sentences of
/// the tests that asked.
std::string listing(const std::vector<Asked>& asked);

/// The question that a number of the listing ("3") means; or, for a probe's name, the first of that
/// name without values, else the first of that name. Throws Error that tells what there is.
const Asked& pick(const std::vector<Asked>& asked, const std::string& what);

/// Its number in the listing, from 1.
std::size_t number_of(const std::vector<Asked>& asked, const Asked& one);

}  // namespace carlo::grader
