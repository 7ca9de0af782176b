#pragma once

#include "grader/protocol/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// A table of raw values for people: how many there are, then its first `most` rows (all for 0),
/// each value beside what it is, and so that it reads back the same. Of rows that are longer than
/// they have names, the first `most` values are shown; what is wider than 80 columns goes on below,
/// but where all is shown a row stays a line.
///
/// `names` say what the values are. Of a single column: what its rows are in their order, where the
/// last name holds for all rows that are left ("estimate" alone: each is one). Else one a column,
/// where "lower ..." stands for "lower 1", "lower 2" and so on; names of this kind share evenly the
/// columns that the others leave. Where they do not fit, values are called "value 1", "value 2" and
/// so on.
std::string rows_text(const Rows& rows, std::vector<std::string> names, std::size_t most);

/// Whether there are names for all values of such a table.
bool names_fit(const std::vector<std::string>& names, std::size_t rows, std::size_t columns);

}  // namespace carlo::grader
