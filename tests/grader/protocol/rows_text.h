#pragma once

#include "grader/protocol/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// Formats a table of raw values for people: how many there are, then its first `most` rows (all
/// for 0), each value next to its name, so that it reads back the same. If rows are longer than
/// they have names, shows the first `most` values; what is wider than 80 columns continues below,
/// but if everything is shown each row stays a line.
///
/// `names` say what the values are. For a single column: the names of its rows in order, where the
/// last one applies to all remaining rows ("estimate" alone: each is one). Otherwise one per
/// column, where "lower ..." stands for "lower 1", "lower 2" and so on; such names share evenly the
/// columns that the others leave. If they do not fit, values are called "value 1", "value 2" and so
/// on.
std::string rows_text(const Rows& rows, std::vector<std::string> names, std::size_t most);

/// Returns whether there are names for all values of such a table.
bool names_fit(const std::vector<std::string>& names, std::size_t rows, std::size_t columns);

}  // namespace carlo::grader
